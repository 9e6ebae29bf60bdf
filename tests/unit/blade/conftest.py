"""A small blade and simple blocks of 20-node hexahedra."""

import numpy as np
import pytest

from bladerub.blade.elasticity import Material, Solid
from bladerub.blade.mesh import hexahedral_mesh

TITANIUM = {"young_modulus": 110e9, "poisson_ratio": 0.32, "density": 4430.0}


def section(span, **changes):
    standard = {"chord": 0.08, "thickness": 0.08, "camber": 0.0, "stagger": 0.0, "sweep": 0.0, "lean": 0.0}
    return {"span": span, **standard, **changes}


@pytest.fixture
def blade_config():
    """The ``blade`` block of a straight plate of a blade, to be changed at will."""
    return {
        "material": dict(TITANIUM),
        "hub_radius": 0.45,
        "length": 0.2,
        "sections": [section(0.0), section(1.0)],
        "mesh": {"chordwise": 7, "thickness": 1, "spanwise": 3},
    }


@pytest.fixture
def twisted_config(blade_config):
    """The same, tapered, cambered and twisted."""
    blade_config["sections"] = [
        section(0.0, thickness=0.1, camber=35.0, stagger=20.0),
        section(1.0, chord=0.075, thickness=0.05, camber=10.0, stagger=50.0, sweep=-0.004, lean=0.003),
    ]
    return blade_config


@pytest.fixture
def make_block():
    """Make a `Solid` of given side lengths, element counts, origin and distortion of its inside."""

    def make(
        size, counts, origin=(0.0, 0.0, 0.0), poisson=0.3, young=2e11, clamp_bottom=False, distortion=0.0
    ):
        size, origin = np.asarray(size, dtype=float), np.asarray(origin, dtype=float)

        def points(*cube):
            cube = np.stack(cube)
            bubble = np.prod(cube * (1 - cube), axis=0)
            shift = distortion * bubble * np.array([[1.0], [-2.0], [1.5]])
            return (cube + shift) * size[:, None] + origin[:, None]

        mesh, parameters = hexahedral_mesh(*(np.linspace(0, 1, n + 1) for n in counts), points)
        clamped = np.flatnonzero(parameters[2] == 0) if clamp_bottom else ()
        return Solid(mesh, Material(young, poisson, 7800.0), clamped)

    return make
