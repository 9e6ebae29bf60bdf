import numpy as np
from skfem import MeshTet1


def tetrahedral_mesh(xi, eta, zeta, points):
    """As `bladerub.blade.mesh.hexahedral_mesh`, each cell of the lattice cut into tetrahedra."""
    from bladerub.extras.blade_meshes import MeshTetP2

    cube = MeshTet1.init_tensor(xi, eta, zeta)
    edges = np.diff(cube.p[:, cube.t], axis=1)
    left_handed = np.einsum("in,in->n", np.cross(edges[:, 0], edges[:, 1], axis=0), edges[:, 2]) < 0
    t = np.where(left_handed, cube.t[[1, 0, 2, 3]], cube.t)
    cube = MeshTet1(cube.p, t)
    parameters = np.hstack([cube.p, cube.p[:, cube.edges].mean(axis=1)])
    return MeshTetP2(points(*parameters), cube.t), parameters
