"""The blade's mesh for other programs: Abaqus and CalculiX, Gmsh, VTK."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory

import meshio
import numpy as np

from bladerub.blade.surface import NAMES, boundary_faces
from bladerub.io import atomic

_FACES = {20: "quad8", 10: "triangle6"}


def write_mesh_file(
    path: str | Path,
    points: np.ndarray,
    cells: np.ndarray,
    node_sets: Mapping[str, np.ndarray],
    fields: Mapping[str, np.ndarray] | None = None,
) -> None:
    """Write the mesh in the format that the suffix of `path` names.

    Parameters
    ----------
    path : path-like
        Ends in ``.inp``, ``.msh`` or ``.vtu``.
    points : (n_nodes, 3) ndarray
        Nodes, m.
    cells : (n_elements, 20 or 10) ndarray of int
        Nodes of the elements, in the order of CalculiX and VTK.
    node_sets : mapping of str to ndarray of int
        Become node sets in ``.inp``; in ``.msh`` physical groups of the faces of the surface that lie in
        them, or of points where there are none; in ``.vtu`` point data, 1 on the nodes of the set.
    fields : mapping of str to (n_nodes, 3) ndarray, optional
        Modes and displacements by name, more point data in ``.vtu``; the others have no place for them.

    Raises
    ------
    ValueError
        If the suffix is another.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in WRITERS:
        raise ValueError(f"{path}: must end in {', '.join(WRITERS)}")
    with TemporaryDirectory() as scratch, atomic.writing(path, "wb") as stream:
        whole = Path(scratch) / f"mesh{suffix}"  # meshio wants a path
        WRITERS[suffix](str(whole), points, cells, node_sets, fields or {})
        stream.write(whole.read_bytes())


def block(points: np.ndarray, cells: np.ndarray) -> tuple[str, np.ndarray]:
    """Give `cells` with their name in meshio, or the nodes as such where there are none."""
    if not len(cells):
        return "vertex", np.arange(len(points))[:, None]
    return NAMES[cells.shape[1]], cells


def _write_inp(path: str, points, cells, node_sets, _) -> None:
    meshio.abaqus.write(
        path, meshio.Mesh(points, [(NAMES[cells.shape[1]], cells)], point_sets=dict(node_sets))
    )


def _write_vtu(path: str, points, cells, node_sets, fields) -> None:
    marks = {
        name: np.isin(np.arange(len(points)), nodes).astype(np.int8) for name, nodes in node_sets.items()
    }
    data = marks | dict(fields)
    meshio.vtu.write(path, meshio.Mesh(points, [block(points, cells)], point_data=data))


def _write_msh(path: str, points, cells, node_sets, _) -> None:
    surface = boundary_faces(cells)
    blocks, groups = [(NAMES[cells.shape[1]], cells)], {"blade": (1, 3)}
    for tag, (name, nodes) in enumerate(node_sets.items(), 2):
        inside = surface[np.isin(surface, nodes).all(axis=1)]
        if len(inside):
            blocks.append((_FACES[cells.shape[1]], np.hstack([inside[:, ::2], inside[:, 1::2]])))
            groups[name] = (tag, 2)
        else:
            blocks.append(("vertex", np.asarray(nodes)[:, None]))
            groups[name] = (tag, 0)
    tags = [np.full(len(rows), tag) for (_, rows), (tag, _) in zip(blocks, groups.values(), strict=True)]
    mesh = meshio.Mesh(
        points,
        blocks,
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data={name: np.array(group) for name, group in groups.items()},
    )
    meshio.gmsh.write(path, mesh, fmt_version="2.2")


WRITERS: dict[str, Callable] = {".inp": _write_inp, ".msh": _write_msh, ".vtu": _write_vtu}
"""Formats by the suffix of the file."""
