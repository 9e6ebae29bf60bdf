"""Mesh of 20-node hexahedra with true curved geometry at the mid-side nodes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from skfem import MeshHex1
from skfem.element import Element, ElementHexS2

from bladerub.blade.geometry import BladeShape, check_interface, lattice
from bladerub.blade.model import N_INTERFACE


@dataclass(repr=False)
class MeshHexS2(MeshHex1):
    """Hexahedra mapped by the 20-node serendipity element, corners first in `doflocs`, then edge midpoints.

    scikit-fem has an isoparametric `MeshHex2`, but of 27 nodes: its geometry would be finer than the
    displacement and no longer that of the C3D20 element of other codes.
    """

    elem: type[Element] = ElementHexS2

    @property
    def points(self) -> np.ndarray:
        """Nodes (n_nodes, 3), m."""
        return self.doflocs.T

    @property
    def hexahedra(self) -> np.ndarray:
        """Nodes of each element (n_elements, 20), in the order of CalculiX's C3D20 and of VTK."""
        return self.dofs.element_dofs[_C3D20_ORDER].T


def _c3d20_order() -> np.ndarray:
    """Position in scikit-fem's element of each node of C3D20: corners, bottom, top, then upright edges."""
    ring = [(0, 0), (1, 0), (1, 1), (0, 1)]
    ring_middle = [(0.5, 0), (1, 0.5), (0.5, 1), (0, 0.5)]
    wanted = [
        (x, y, z)
        for corners, heights in ((ring, (0, 1)), (ring_middle, (0, 1)), (ring, (0.5,)))
        for z in heights
        for x, y in corners
    ]
    places = {tuple(place): index for index, place in enumerate(ElementHexS2.doflocs.tolist())}
    return np.array([places[node] for node in wanted])


_C3D20_ORDER = _c3d20_order()
_ALONG_THE_CUBE = [7, 4, 6, 5, 2, 1, 3, 0]  # scikit-fem numbers its tensor meshes left-handed


def hexahedral_mesh(
    xi: np.ndarray, eta: np.ndarray, zeta: np.ndarray, points
) -> tuple[MeshHexS2, np.ndarray]:
    """Map a lattice of the unit cube to space.

    Parameters
    ----------
    xi, eta, zeta : ndarray
        Ascending coordinates of the element corners; elements are numbered bottom to top along ζ.
    points : callable
        ``points(xi, eta, zeta) -> (3, n)``: place in space, m.

    Returns
    -------
    mesh : MeshHexS2
        The mesh, every node on `points`.
    parameters : (3, n_nodes) ndarray
        ξ, η, ζ of every node.
    """
    cube = MeshHex1.init_tensor(xi, eta, zeta)
    cube = MeshHex1(cube.doflocs, cube.t[_ALONG_THE_CUBE])
    parameters = np.hstack([cube.p, cube.p[:, cube.edges].mean(axis=1)])
    return MeshHexS2(points(*parameters), cube.t), parameters


@dataclass(frozen=True)
class BladeMesh:
    """The blade's mesh and the node sets on it.

    Parameters
    ----------
    mesh : MeshHexS2
        The elements.
    root, tip : ndarray of int
        Nodes of the clamped root and of the tip face.
    interface : (8,) ndarray of int
        Nodes of the tip's camber line that may touch the casing, leading to trailing edge.
    """

    mesh: MeshHexS2
    root: np.ndarray = field(repr=False)
    tip: np.ndarray = field(repr=False)
    interface: np.ndarray

    @classmethod
    def from_shape(cls, shape: BladeShape, mesh: Mapping[str, int]) -> BladeMesh:
        """Mesh `shape` with the element counts of the config's ``blade.mesh``.

        Raises
        ------
        ValueError
            If the tip's camber line has fewer than 8 nodes.
        """
        check_interface(mesh)
        hexahedra, (xi, eta, zeta) = hexahedral_mesh(*lattice(mesh), shape.points)
        tip = np.flatnonzero(zeta == 1)
        camber_line = tip[np.isclose(eta[tip], 0.5)]
        camber_line = camber_line[np.argsort(xi[camber_line])]
        evenly = np.rint(np.linspace(0, camber_line.size - 1, N_INTERFACE)).astype(int)
        return cls(hexahedra, np.flatnonzero(zeta == 0), tip, camber_line[evenly])
