"""The blade's mesh for other programs: Abaqus and CalculiX, Gmsh, VTK."""

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from bladerub.blade.surface import boundary_faces
from bladerub.extras.blade_meshes import NAMES
from bladerub.io import atomic
from bladerub.io.errors import package

meshio = package("meshio", "mesh")

FORMATS = {".inp": "abaqus", ".msh": "gmsh22", ".vtu": "vtu"}  # names in meshio by suffix
_FACES = {20: "quad8", 10: "triangle6"}


def write_mesh_file(
    path: str | Path,
    points: np.ndarray,
    cells: np.ndarray,
    node_sets: Mapping[str, np.ndarray],
    fields: Mapping[str, np.ndarray] | None = None,
) -> None:
    """Write a mesh as ``.inp``, ``.msh`` or ``.vtu``, as the suffix of `path` says, one of `FORMATS`.

    `points` (n_nodes, 3) are in m, `cells` (n_elements, 20 or 10) in the order of CalculiX and VTK. The node
    sets become node sets in ``.inp``; in ``.msh`` physical groups of the faces of the surface that lie in
    them, or of points if there are none; in ``.vtu`` point data, 1 on the nodes of the set. Modes and
    displacements (`fields`) are point data in ``.vtu``; the other formats have no place for them.
    """
    suffix = Path(path).suffix.lower()
    if suffix == ".inp":
        mesh = meshio.Mesh(points, [block(points, cells)], point_sets=dict(node_sets))
    elif suffix == ".msh":
        mesh = _with_physical_groups(points, cells, node_sets)
    else:
        number = np.arange(len(points))
        marks = {name: np.isin(number, nodes).astype(np.int8) for name, nodes in node_sets.items()}
        mesh = meshio.Mesh(points, [block(points, cells)], point_data=marks | dict(fields or {}))
    with atomic.writing(path, "wb") as stream:
        mesh.write(stream.name, FORMATS[suffix])  # meshio wants a path


def block(points: np.ndarray, cells: np.ndarray) -> tuple[str, np.ndarray]:
    """Give `cells` with their name in meshio, or the nodes as vertices if there are no cells."""
    if not len(cells):
        return "vertex", np.arange(len(points))[:, None]
    return NAMES[cells.shape[1]], cells


def _with_physical_groups(points: np.ndarray, cells: np.ndarray, node_sets) -> meshio.Mesh:
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
    return meshio.Mesh(
        points,
        blocks,
        cell_data={"gmsh:physical": tags, "gmsh:geometrical": tags},
        field_data={name: np.array(group) for name, group in groups.items()},
    )
