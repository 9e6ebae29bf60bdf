from dataclasses import replace

import numpy as np
import pytest
from blade_parts import TWISTED, section

from bladerub.blade.elasticity import Solid
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.settings.blade import Material


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
