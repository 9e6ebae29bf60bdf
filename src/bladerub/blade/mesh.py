"""Meshes of quadratic elements, with true curved geometry at the mid-side nodes, and the blade's own mesh."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import ClassVar, Protocol

import numpy as np
from skfem import MeshHex1, MeshTet2
from skfem.element import Element, ElementHexS2, ElementTetP2
from skfem.quadrature import get_quadrature
from skfem.refdom import RefTet

from bladerub.blade.geometry import check_interface, lattice
from bladerub.blade.model import N_INTERFACE


class _Solid:
    """What the meshes of both kinds of element have in common; corners first in ``doflocs``, then edges.

    ``quadrature`` gives the integration points of the stiffness, ``mass_quadrature`` of mass and volume.
    """

    order: ClassVar[np.ndarray]  # in scikit-fem's element, of the nodes of C3D20 or C3D10 (CalculiX, VTK)

    @property
    def points(self) -> np.ndarray:
        """Nodes (n_nodes, 3), m."""
        return self.doflocs.T

    @property
    def cells(self) -> np.ndarray:
        """Nodes of each element (n_elements, 20 or 10), in the order of CalculiX and of VTK."""
        return self.dofs.element_dofs[self.order].T


def _order(element: type[Element], wanted: list[tuple[float, ...]]) -> np.ndarray:
    places = {tuple(place): index for index, place in enumerate(element.doflocs.tolist())}
    return np.array([places[node] for node in wanted])


def _c3d20() -> list[tuple[float, ...]]:
    """Nodes of C3D20 on the unit cube: corners, edges at the bottom, at the top, then upright."""
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    ring_middle = [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)]
    return [
        (x, y, z)
        for corners, heights in ((ring, (0, 1)), (ring_middle, (0, 1)), (ring, (0.5,)))
        for z in heights
        for x, y in corners
    ]


_C3D10 = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
_C3D10 += [(0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0), (0, 0, 0.5), (0.5, 0, 0.5), (0, 0.5, 0.5)]


@dataclass(repr=False)
class MeshHexS2(_Solid, MeshHex1):
    """Hexahedra mapped by the 20-node serendipity element.

    scikit-fem has an isoparametric `MeshHex2`, but of 27 nodes: its geometry would be finer than the
    displacement and no longer that of the C3D20 element of other codes.
    """

    elem: type[Element] = ElementHexS2
    order: ClassVar[np.ndarray] = _order(ElementHexS2, _c3d20())

    @staticmethod
    def quadrature() -> tuple[np.ndarray, np.ndarray]:
        """Give the 3×3×3 Gauss points (3, 27) and weights (27,) on the unit cube."""
        x, w = np.polynomial.legendre.leggauss(3)
        x, w = 0.5 * (x + 1), 0.5 * w
        points = np.stack([axis.ravel() for axis in np.meshgrid(x, x, x, indexing="ij")])
        return points, np.einsum("i,j,k->ijk", w, w, w).ravel()

    mass_quadrature = quadrature


@dataclass(repr=False)
class MeshTetP2(_Solid, MeshTet2):
    """Tetrahedra mapped by the 10-node element."""

    elem: type[Element] = ElementTetP2
    order: ClassVar[np.ndarray] = _order(ElementTetP2, _C3D10)

    @staticmethod
    def quadrature() -> tuple[np.ndarray, np.ndarray]:
        """Give the points (3, 4) and weights (4,) of the second degree on the unit tetrahedron.

        They are those of C3D10 in CalculiX and Abaqus, exact for the stiffness of straight elements and just
        enough to strain every shape of the element.
        """
        return get_quadrature(RefTet, 2)

    @staticmethod
    def mass_quadrature() -> tuple[np.ndarray, np.ndarray]:
        """Give points (3, 14) and weights (14,) of the fifth degree, as the mass needs the fourth.

        CalculiX has the four points of the stiffness for the mass as well, and so is 3e-4 off in the eighth
        frequency of a coarse mesh.
        """
        return get_quadrature(RefTet, 5)


SolidMesh = MeshHexS2 | MeshTetP2
"""A mesh that `bladerub.blade.elasticity.Solid` takes."""


@dataclass(frozen=True)
class NodeCloud:
    """The nodes of a body whose elements are not known: a mesh without elements."""

    points: np.ndarray = field(repr=False)  # (n_nodes, 3), m

    @property
    def cells(self) -> np.ndarray:
        """Nodes of no elements (0, 20)."""
        return np.empty((0, 20), dtype=int)


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


def solid_mesh(points: np.ndarray, cells: np.ndarray) -> tuple[SolidMesh, np.ndarray]:
    """Make a mesh of quadratic elements, its nodes numbered as scikit-fem does.

    `points` (n_points, 3) are in m; `cells` (n_elements, 20 or 10) are in the order of CalculiX and VTK. Also
    returns the row of `points` (n_nodes,) of each node of the mesh; rows that no element uses are left out.

    Raises
    ------
    ValueError
        If two elements that share an edge do not share its middle, or edges share a mid-side node; names an
        element by its row in `cells`, counted from 1.
    """
    kind = MeshHexS2 if cells.shape[1] == 20 else MeshTetP2
    n_corners = kind.elem.refdom.nnodes
    vertices, corners = np.unique(cells[:, :n_corners], return_inverse=True)
    t = np.empty((n_corners, len(cells)), dtype=np.int32)
    t[kind.order[:n_corners]] = corners.reshape(-1, n_corners).T
    numbered = kind(np.ascontiguousarray(points[vertices].T), t).cells
    origin = np.empty(numbered.max() + 1, dtype=int)
    origin[numbered] = cells
    loose = np.any(origin[numbered] != cells, axis=1)
    if loose.any():
        raise ValueError(f"element {np.argmax(loose) + 1}: must share the mid-side nodes of its neighbours")
    if np.unique(origin).size < origin.size:
        twice = np.argmax(np.bincount(origin) > 1)
        raise ValueError(f"node {twice + 1}: is in the middle of more than one edge, or a corner as well")
    return kind(np.ascontiguousarray(points[origin].T), t), origin


class Shape(Protocol):
    """A blade as a map from the unit cube, such as `bladerub.blade.geometry.BladeShape`."""

    def points(self, xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray) -> np.ndarray:
        """Map chordwise ξ, η through the thickness and spanwise ζ to space: points (3, ...), m."""


@dataclass(frozen=True)
class BladeMesh:
    """The blade's mesh and the node sets on it."""

    mesh: SolidMesh | NodeCloud  # nodes alone where another program has made matrices of the elements
    root: np.ndarray = field(repr=False)  # nodes that are clamped
    tip: np.ndarray = field(repr=False)  # nodes of the tip face
    interface: np.ndarray  # (8,) nodes of the tip's camber line that may touch, leading to trailing edge

    @classmethod
    def from_shape(cls, shape: Shape, mesh: Mapping[str, int]) -> "BladeMesh":
        """Mesh `shape` with the element counts of the config's ``blade.mesh``.

        Raises ValueError if the tip's camber line has fewer than 8 nodes.
        """
        check_interface(mesh)
        hexahedra, (xi, eta, zeta) = hexahedral_mesh(*lattice(mesh), shape.points)
        tip = np.flatnonzero(zeta == 1)
        camber_line = tip[np.isclose(eta[tip], 0.5)]
        camber_line = camber_line[np.argsort(xi[camber_line])]
        evenly = np.rint(np.linspace(0, camber_line.size - 1, N_INTERFACE)).astype(int)
        return cls(hexahedra, np.flatnonzero(zeta == 0), tip, camber_line[evenly])


@dataclass(frozen=True)
class MeshedBlade:
    """A meshed blade, parametric or imported, ready to be reduced."""

    mesh: BladeMesh  # in the frame of `bladerub.blade.geometry`
    tip_cone: float  # half angle of the flow path at the tip, rad; positive where it widens with x
    length: float  # from root to tip, m

    @property
    def tip_radius(self) -> float:
        """Mean distance of the tip's nodes from the engine axis, m."""
        y, z = self.mesh.mesh.points[self.mesh.tip, 1:].T
        return float(np.hypot(y, z).mean())
