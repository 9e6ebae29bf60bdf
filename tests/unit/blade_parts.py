from dataclasses import replace

import numpy as np
import pytest

from bladerub.blade.elasticity import Solid
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.settings.blade import Material, Mesh, Reduction, SpanSection
from bladerub.settings.study import whole

REDUCTION = Reduction(
    f_omega_max=0.4, modes_per_speed=3, rank_tolerance=1e-5, accuracy_speeds=3, accuracy_modes=8
)
TITANIUM = Material(young_modulus=110e9, poisson_ratio=0.32, density=4430.0)


def section(span, **changes):
    standard = {"chord": 0.08, "thickness": 0.08, "camber": 0.0, "stagger": 0.0, "sweep": 0.0, "lean": 0.0}
    return SpanSection.model_construct(span=span, **standard | changes)


BLADE = whole().model_fields["blade"].annotation  # a source may plug in
TWISTED = BLADE(
    material=TITANIUM,
    hub_radius=0.45,
    length=0.2,
    tip_cone=0.0,
    sections=[
        section(0.0, thickness=0.1, camber=35.0, stagger=20.0),
        section(1.0, chord=0.075, thickness=0.05, camber=10.0, stagger=50.0, sweep=-0.004, lean=0.003),
    ],
    mesh=Mesh(chordwise=7, thickness=1, spanwise=3),
)


@pytest.fixture
def blade_config():
    return TWISTED.replaced("sections", [section(0.0), section(1.0)])


@pytest.fixture
def twisted_config():
    return TWISTED


@pytest.fixture(scope="session")
def make_block():
    """Make a `Solid` of given side lengths, element counts, origin and distortion of its inside."""

    def make(size, counts, origin=(0, 0, 0), poisson=0.3, clamp_bottom=False, distortion=0.0, make_mesh=None):
        size, origin = np.asarray(size, dtype=float), np.asarray(origin, dtype=float)

        def points(*cube):
            cube = np.stack(cube)
            bubble = np.prod(cube * (1 - cube), axis=0)
            shift = distortion * bubble * np.array([[1.0], [-2.0], [1.5]])
            return (cube + shift) * size[:, None] + origin[:, None]

        lattice = (np.linspace(0, 1, n + 1) for n in counts)
        mesh, parameters = (make_mesh or hexahedral_mesh)(*lattice, points)
        clamped = np.flatnonzero(parameters[2] == 0) if clamp_bottom else ()
        return Solid(mesh, Material(young_modulus=2e11, poisson_ratio=poisson, density=7800.0), clamped)

    return make


@pytest.fixture
def oscillators(blade):
    """Thirty uncoupled unit masses, the j-th of frequency j Hz at rest, all stiffened by 100 f_omega² N/m."""
    unit, squares = np.eye(30), (2 * np.pi * np.arange(1, 31)) ** 2
    stiffness = {"stiffness_0": np.diag(squares), "stiffness_1": 100 * unit, "stiffness_2": 0 * unit}
    return replace(blade, mass=unit, f1_hz=1.0, **stiffness)
