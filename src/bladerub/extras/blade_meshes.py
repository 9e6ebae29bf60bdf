"""Meshes of blades from anywhere: of hexahedra, of tetrahedra, of nodes alone, and those of built blades."""

from dataclasses import dataclass, field
from pathlib import Path
from typing import ClassVar

import numpy as np
from skfem import MeshTet2
from skfem.element import Element, ElementTetP2
from skfem.quadrature import get_quadrature
from skfem.refdom import RefTet

from bladerub.blade.built import BuiltBlade
from bladerub.blade.files import accuracy_path, mesh_path
from bladerub.blade.frequencies import ACCURACY_COLUMNS
from bladerub.blade.mesh import BladeMesh, MeshHexS2, SolidMesh
from bladerub.blade.validation import read_reduced_blade
from bladerub.io import hdf5, tables
from bladerub.io.errors import DamagedFile

NAMES = {20: "hexahedron20", 10: "tetra10"}  # in meshio, by the number of nodes

EDGES = {  # by the number of nodes: the corners at the ends of each edge, in the order of its mid-side nodes
    20: np.array(
        [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    ),
    10: np.array([(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)]),
}


@dataclass(repr=False)
class MeshTetP2(SolidMesh, MeshTet2):
    """Tetrahedra mapped by the 10-node element."""

    elem: type[Element] = ElementTetP2
    order: ClassVar[list[int]] = list(range(10))

    @staticmethod
    def quadrature() -> tuple[np.ndarray, np.ndarray]:
        """Give the four points of C3D10: exact for straight elements, and they strain every shape of it."""
        return get_quadrature(RefTet, 2)

    @staticmethod
    def mass_quadrature() -> tuple[np.ndarray, np.ndarray]:
        """Give 14 points, exact to the fifth degree: the mass needs the fourth (CalculiX has only four)."""
        return get_quadrature(RefTet, 5)


@dataclass(frozen=True)
class NodeCloud:
    """The nodes of a body whose elements are not known: a mesh without elements."""

    points: np.ndarray = field(repr=False)  # (n_nodes, 3), m
    cells: np.ndarray = field(repr=False, default_factory=lambda: np.empty((0, 20), dtype=int))


def solid_mesh(points: np.ndarray, cells: np.ndarray) -> tuple[SolidMesh, np.ndarray]:
    """Make a mesh of quadratic elements, its nodes numbered as scikit-fem does.

    `points` (n_points, 3) are in m; `cells` (n_elements, 20 or 10) are in the order of CalculiX and VTK. Also
    returns the row of `points` (n_nodes,) of each node of the mesh; rows that no element uses are left out.
    A ValueError names an element, or node, from 1 whose mid-side nodes are not shared as its edges are.
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


def read_built(reduced_model: Path) -> BuiltBlade:
    """Read what `bladerub.blade.built.write` wrote, to the last bit; an OSError names a damaged file."""
    path = mesh_path(reduced_model)
    data, attributes = hdf5.read(path)
    try:
        points, cells = data["points"], data["cells"]
        mesh, _ = solid_mesh(points, cells) if len(cells) else (NodeCloud(points), None)
        return BuiltBlade(
            read_reduced_blade(reduced_model),
            BladeMesh(mesh, *(data[f"{name}_nodes"] for name in ("root", "tip", "interface"))),
            *map(data.__getitem__, ("frequency", "mode_shape", "recovery", "static_displacement", "f_omega")),
            tables.read(accuracy_path(reduced_model), ACCURACY_COLUMNS),
            attributes["made_from"],
        )
    except (KeyError, ValueError) as error:
        raise DamagedFile(f"{path}: not the mesh of a blade ({error})") from error
