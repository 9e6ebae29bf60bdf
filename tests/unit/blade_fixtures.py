import copy

import numpy as np
import pytest
from blade_parts import TWISTED, section

from bladerub.blade.elasticity import Material, Solid
from bladerub.blade.mesh import hexahedral_mesh
from bladerub.blade.model import ReducedBlade


@pytest.fixture
def blade_config():
    """The ``blade`` block of a straight plate of a blade, to be changed at will."""
    return copy.deepcopy(TWISTED | {"sections": [section(0.0), section(1.0)]})


@pytest.fixture
def twisted_config():
    """The same, tapered, cambered and twisted."""
    return copy.deepcopy(TWISTED)


@pytest.fixture
def make_block():
    """Make a `Solid` of given side lengths, element counts, origin and distortion of its inside."""

    def make(
        size,
        counts,
        origin=(0.0, 0.0, 0.0),
        poisson=0.3,
        young=2e11,
        clamp_bottom=False,
        distortion=0.0,
        make_mesh=hexahedral_mesh,
    ):
        size, origin = np.asarray(size, dtype=float), np.asarray(origin, dtype=float)

        def points(*cube):
            cube = np.stack(cube)
            bubble = np.prod(cube * (1 - cube), axis=0)
            shift = distortion * bubble * np.array([[1.0], [-2.0], [1.5]])
            return (cube + shift) * size[:, None] + origin[:, None]

        mesh, parameters = make_mesh(*(np.linspace(0, 1, n + 1) for n in counts), points)
        clamped = np.flatnonzero(parameters[2] == 0) if clamp_bottom else ()
        return Solid(mesh, Material(young, poisson, 7800.0), clamped)

    return make


@pytest.fixture
def oscillators():
    """Thirty uncoupled unit masses, the j-th of frequency j Hz at rest, all stiffened by 100 f_omega² N/m."""
    n = 30
    squares = (2 * np.pi * np.arange(1, n + 1)) ** 2
    return ReducedBlade(
        mass=np.eye(n),
        stiffness_0=np.diag(squares),
        stiffness_1=100 * np.eye(n),
        stiffness_2=np.zeros((n, n)),
        node_position=np.zeros((8, 3)),
        radial_direction=np.zeros((8, 3)),
        tangential_direction=np.zeros((8, 3)),
        f1_hz=1.0,
        f_omega_max=0.4,
        eta=2,
        rank_tolerance=1e-5,
        length=0.2,
    )
