"""The blade's mesh of quadratic elements, curved at their mid-side nodes, and its free coordinates."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

import numpy as np
from skfem import MeshHex1
from skfem.element import Element, ElementHexS2

from bladerub.blade.geometry import check_interface, corner_jacobians, lattice
from bladerub.blade.model import N_INTERFACE
from bladerub.io.errors import BadInput
from bladerub.settings.blade import Mesh

LENGTH_TOLERANCE = 0.05  # of a blade from elsewhere to ``blade.length``: its root need not be a cylinder


class FreeCoordinates:
    """The coordinates of `n_nodes` nodes that are not `clamped`; full vectors have all, node by node."""

    def __init__(self, n_nodes: int, clamped=()):
        self.n_nodes = n_nodes
        is_free = np.ones((n_nodes, 3), dtype=bool)
        is_free[np.asarray(clamped, dtype=int)] = False
        self.free = np.flatnonzero(is_free)  # (n,), place of each free coordinate in the full vector
        self.axis = self.free % 3  # (n,), 0, 1, 2 for x, y, z

    def full(self, u: np.ndarray) -> np.ndarray:
        """Displacement (n_nodes, 3) of all nodes for the free coordinates `u`, m."""
        vector = np.zeros(3 * self.n_nodes)
        vector[self.free] = u
        return vector.reshape(-1, 3)

    def coordinates(self, nodes: np.ndarray) -> np.ndarray:
        """Places in the free vector of the x, y, z of `nodes`, node by node."""
        return np.searchsorted(self.free, (3 * np.asarray(nodes)[:, None] + np.arange(3)).ravel())


class SolidMesh:
    """What meshes of quadratic elements have in common; corners first in ``doflocs``, then edges.

    ``quadrature`` gives the integration points of the stiffness, ``mass_quadrature`` of mass and volume.
    """

    order: ClassVar[list[int]]  # in scikit-fem's element, of the nodes of C3D20 or C3D10 (CalculiX, VTK)

    @property
    def points(self) -> np.ndarray:
        """Nodes (n_nodes, 3), m."""
        return self.doflocs.T

    @property
    def cells(self) -> np.ndarray:
        """Nodes of each element (n_elements, 20 or 10), in the order of CalculiX and of VTK."""
        return self.dofs.element_dofs[self.order].T


@dataclass(repr=False)
class MeshHexS2(SolidMesh, MeshHex1):
    """Hexahedra mapped by the 20-node serendipity element.

    scikit-fem has an isoparametric `MeshHex2`, but of 27 nodes: its geometry would be finer than the
    displacement and no longer that of the C3D20 element of other codes.
    """

    elem: type[Element] = ElementHexS2
    order: ClassVar[list[int]] = [7, 4, 1, 5, 6, 2, 0, 3, 17, 11, 12, 18, 14, 9, 10, 16, 19, 13, 8, 15]

    @staticmethod
    def quadrature() -> tuple[np.ndarray, np.ndarray]:
        """Give the 3×3×3 Gauss points (3, 27) and weights (27,) on the unit cube."""
        x, w = np.polynomial.legendre.leggauss(3)
        x, w = 0.5 * (x + 1), 0.5 * w
        points = np.stack([axis.ravel() for axis in np.meshgrid(x, x, x, indexing="ij")])
        return points, np.einsum("i,j,k->ijk", w, w, w).ravel()

    mass_quadrature = quadrature


_ALONG_THE_CUBE = [7, 4, 6, 5, 2, 1, 3, 0]  # scikit-fem numbers its tensor meshes left-handed


def hexahedral_mesh(
    xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray, points
) -> tuple[MeshHexS2, np.ndarray]:
    """Map a lattice of the unit cube to space by ``points(xi, eta, zeta) -> (3, n)``, m.

    `xi`, `eta`, `zeta` are the ascending coordinates of the element corners; elements are numbered bottom to
    top along ζ. Also returns ξ, η, ζ (3, n_nodes) of every node.
    """
    cube = MeshHex1.init_tensor(xi, eta, zeta)
    cube = MeshHex1(cube.doflocs, cube.t[_ALONG_THE_CUBE])
    parameters = np.hstack([cube.p, cube.p[:, cube.edges].mean(axis=1)])
    return MeshHexS2(points(*parameters), cube.t), parameters


@dataclass(frozen=True)
class BladeMesh:
    """The blade's mesh and the node sets on it."""

    mesh: SolidMesh  # or the `points` alone, with no `cells`, of a blade of matrices
    root: np.ndarray = field(repr=False)  # nodes that are clamped
    tip: np.ndarray = field(repr=False)  # nodes of the tip face
    interface: np.ndarray  # (j,) nodes of the tip's camber line that may touch, leading to trailing edge

    @classmethod
    def from_shape(cls, shape, mesh: Mesh, n_interface: int = N_INTERFACE) -> "BladeMesh":
        """Mesh `shape`, whose ``points`` map the unit cube as those of `bladerub.blade.geometry.BladeShape`.

        `mesh` has the numbers of elements. ValueError if the tip has too few nodes, or the shape no points.
        """
        check_interface(mesh, n_interface)
        _check_points(shape.points, *np.meshgrid(*lattice(mesh), indexing="ij"))
        hexahedra, (xi, eta, zeta) = hexahedral_mesh(*lattice(mesh), shape.points)
        tip = np.flatnonzero(zeta == 1)
        camber_line = tip[np.isclose(eta[tip], 0.5)]
        camber_line = camber_line[np.argsort(xi[camber_line])]
        evenly = np.rint(np.linspace(0, camber_line.size - 1, n_interface)).astype(int)
        return cls(hexahedra, np.flatnonzero(zeta == 0), tip, camber_line[evenly])


def _check_points(points, xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray) -> None:
    """Raise `BadInput` where `points` gives no coordinates (3, n), or turns an element inside out."""
    mapped = np.asarray(points(xi.ravel(), eta.ravel(), zeta.ravel()))
    if mapped.shape != (3, xi.size):
        raise BadInput(f"points of the shape: has the shape {mapped.shape}; must be x, y, z, (3, {xi.size})")
    inside_out = ~(corner_jacobians(mapped.reshape(3, *xi.shape)) > 0).all(axis=(0, 1, 2))  # or no number
    if inside_out.any():
        span = zeta[0, 0, np.argmax(inside_out)]
        raise BadInput(
            f"points of the shape: an element at span {span:.3g} has no volume, no numbers, or is turned "
            "inside out; xi, eta, zeta must run like right-handed axes, and sections have chord and thickness"
        )


@dataclass(frozen=True)
class MeshedBlade:
    """A meshed blade, parametric or imported, ready to be reduced."""

    mesh: BladeMesh  # in the frame of `bladerub.blade.geometry`
    tip_cone: float  # half angle of the flow path at the tip, rad; positive where it widens with x

    @property
    def length(self) -> float:
        """Mean radius of the tip less that of the clamped nodes, or of the lowest if none is clamped, m."""
        _, y, z = self.mesh.mesh.points.T
        radius, root = np.hypot(y, z), self.mesh.root
        return float(radius[self.mesh.tip].mean() - (radius[root].mean() if root.size else radius.min()))


def check_length(length: float, measured: float, file: str | Path) -> None:
    """Check the ``blade.length`` of a config by that of the blade in a `file`; BadInput if it is another."""
    if not abs(measured / length - 1) <= LENGTH_TOLERANCE:
        raise BadInput(
            f"blade.length = {length:g}: must be that of the blade in {file}, {measured:.4g} m to within "
            f"{LENGTH_TOLERANCE:.0%}; clearances are in this unit"
        )
