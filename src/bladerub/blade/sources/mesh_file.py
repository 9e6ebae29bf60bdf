"""The content of a mesh file: nodes, one kind of quadratic element, node sets."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import meshio
import numpy as np

from bladerub.blade.sources import abaqus
from bladerub.blade.sources.origin import TABLE_SUFFIXES
from bladerub.blade.surface import EDGES

READERS: dict[str, Callable[[str], meshio.Mesh]] = {
    ".inp": abaqus.read,
    ".msh": meshio.gmsh.read,
    ".vtu": meshio.vtu.read,
}
"""Formats by the suffix of the file."""

_QUADRATIC = {"hexahedron20": 20, "tetra10": 10}
_LINEAR = {"hexahedron": 20, "tetra": 10}  # nodes after mid-side ones are added


@dataclass(frozen=True)
class MeshFile:
    """The content of a mesh file.

    `node_sets` are node sets and sets of surface elements of Abaqus, physical groups of surfaces, lines and
    points of Gmsh, and integer point data of VTK (nodes where it is not zero).
    """

    points: np.ndarray = field(repr=False)  # (n_points, 3), in unit and axes of the file, then those added
    cells: np.ndarray = field(repr=False)  # (n_elements, 20 or 10), in the order of CalculiX and VTK
    node_sets: dict[str, np.ndarray]
    is_raised: bool  # whether elements of 8 or 4 nodes got nodes in the middle of their edges


def read(path: str | Path) -> MeshFile:
    """Read the mesh at `path`; a ValueError says why it cannot be used.

    Elements of 8 and 4 nodes, far too stiff in bending, become such of 20 and 10 with straight edges.
    """
    path = Path(path)
    suffix = path.suffix.lower()
    if suffix not in READERS:
        raise ValueError(
            f"must be a mesh file that ends in {', '.join(READERS)}, or a table of sections in "
            f"{', '.join(TABLE_SUFFIXES)}"
        )
    if not path.is_file():
        raise ValueError("there is no such file")
    if path.stat().st_size == 0:
        raise ValueError("is empty")
    try:
        mesh = READERS[suffix](str(path))
    except Exception as error:  # readers of foreign files raise all kinds of errors
        reason = str(error) or type(error).__name__
        raise ValueError(f"is not a {suffix} file that can be read ({reason})") from error
    kind, cells = _volume(mesh)
    points = np.asarray(mesh.points, dtype=float)
    if points.shape[1:] != (3,):
        raise ValueError("nodes must have three coordinates")
    if kind in _LINEAR:
        points, cells = raised(points, cells)
    return MeshFile(points, cells, _node_sets(mesh), kind in _LINEAR)


def raised(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Add nodes in the middle of all edges of hexahedra (n, 8) or tetrahedra (n, 4)."""
    n_corners = cells.shape[1]
    ends = np.sort(cells[:, EDGES[{8: 20, 4: 10}[n_corners]]], axis=-1)
    edges, edge = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    middle = len(points) + edge.reshape(len(cells), -1)
    return np.vstack([points, points[edges].mean(axis=1)]), np.hstack([cells, middle])


def _volume(mesh: meshio.Mesh) -> tuple[str, np.ndarray]:
    blocks = [block for block in mesh.cells if block.dim == 3]
    kinds = list(dict.fromkeys(block.type for block in blocks))
    known = ", ".join([*_QUADRATIC, *_LINEAR])
    if not kinds or not sum(len(block) for block in blocks):
        raise ValueError(f"has no volume elements; must have some of one kind, {known}")
    if len(kinds) > 1:
        raise ValueError(f"mixes {' and '.join(kinds)}; must have elements of one kind")
    (kind,) = kinds
    if kind not in _QUADRATIC | _LINEAR:
        raise ValueError(f"is made of {kind}; must be one of {known}")
    cells = np.concatenate([np.asarray(block.data, dtype=int) for block in blocks])
    if cells.min() < 0 or cells.max() >= len(mesh.points):
        raise ValueError("an element names a node that is not there")
    return kind, cells


def _node_sets(mesh: meshio.Mesh) -> dict[str, np.ndarray]:
    sets = {name: [np.asarray(nodes, dtype=int)] for name, nodes in mesh.point_sets.items()}
    for name, values in mesh.point_data.items():
        if values.ndim == 1 and values.dtype.kind in "iub":
            sets.setdefault(name, []).append(np.flatnonzero(values))
    for name, (tag, _) in mesh.field_data.items():
        for block, physical in zip(mesh.cells, mesh.cell_data.get("gmsh:physical", []), strict=False):
            if block.dim < 3:
                sets.setdefault(name, []).append(np.ravel(block.data[physical == tag]))
    for name, members in mesh.cell_sets.items():
        for block, rows in zip(mesh.cells, members, strict=False):
            if block.dim < 3 and rows is not None and not name.startswith("gmsh:"):
                sets.setdefault(name, []).append(np.ravel(block.data[np.asarray(rows, dtype=int)]))
    merged = {name: np.unique(np.concatenate(nodes)) for name, nodes in sets.items()}
    return {name: nodes for name, nodes in merged.items() if nodes.size or name in mesh.point_sets}
