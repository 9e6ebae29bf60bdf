"""What the blades of the tests are made of."""

import numpy as np
from skfem import MeshTet1

from bladerub.blade.mesh import MeshTetP2

TITANIUM = {"young_modulus": 110e9, "poisson_ratio": 0.32, "density": 4430.0}


def section(span, **changes):
    standard = {"chord": 0.08, "thickness": 0.08, "camber": 0.0, "stagger": 0.0, "sweep": 0.0, "lean": 0.0}
    return {"span": span, **standard, **changes}


def tetrahedral_mesh(xi, eta, zeta, points):
    """As `bladerub.blade.mesh.hexahedral_mesh`, each cell of the lattice cut into tetrahedra."""
    cube = MeshTet1.init_tensor(xi, eta, zeta)
    edges = np.diff(cube.p[:, cube.t], axis=1)
    left_handed = np.einsum("in,in->n", np.cross(edges[:, 0], edges[:, 1], axis=0), edges[:, 2]) < 0
    t = np.where(left_handed, cube.t[[1, 0, 2, 3]], cube.t)
    cube = MeshTet1(cube.p, t)
    parameters = np.hstack([cube.p, cube.p[:, cube.edges].mean(axis=1)])
    return MeshTetP2(points(*parameters), cube.t), parameters
