"""The content of a mesh file: nodes, one kind of quadratic element, node sets."""

import io
import re
from dataclasses import dataclass, field
from pathlib import Path

import meshio
import numpy as np

from bladerub.blade.sources import origin
from bladerub.blade.surface import EDGES

_NAMES_IN_MESHIO = {
    **dict.fromkeys(("CPS6", "S6", "M3D6", "SFM3D6"), "STRI65"),
    **dict.fromkeys(("CPS8", "CPS8R", "CPE8", "CPE8R", "S8", "M3D8", "M3D8R", "SFM3D8"), "S8R"),
    **dict.fromkeys(("CPE3", "M3D3", "SFM3D3"), "CPS3"),
    **dict.fromkeys(("CPE4", "CPE4R", "M3D4", "M3D4R", "SFM3D4"), "CPS4"),
}  # of the elements of surfaces that Gmsh and others write in Abaqus files

_KINDS = ("hexahedron20", "tetra10", "hexahedron", "tetra")  # in meshio; of the last two, quadratic are made


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
    origin.check_file(path)
    suffix = path.suffix.lower()
    try:
        mesh = READERS[suffix](str(path))
    except Exception as error:  # readers of foreign files raise all kinds of errors
        reason = str(error) or type(error).__name__
        raise ValueError(f"is not a {suffix} file that can be read ({reason})") from error
    cells = _volume(mesh)
    points = np.asarray(mesh.points, dtype=float)
    if points.shape[1:] != (3,):
        raise ValueError("nodes must have three coordinates")
    is_linear = cells.shape[1] < 10
    if is_linear:
        points, cells = raised(points, cells)
    return MeshFile(points, cells, _node_sets(mesh), is_linear)


def raised(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Add nodes in the middle of all edges of hexahedra (n, 8) or tetrahedra (n, 4)."""
    ends = np.sort(cells[:, EDGES[{8: 20, 4: 10}[cells.shape[1]]]], axis=-1)
    edges, edge = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    middle = len(points) + edge.reshape(len(cells), -1)
    return np.vstack([points, points[edges].mean(axis=1)]), np.hstack([cells, middle])


def _volume(mesh: meshio.Mesh) -> np.ndarray:
    blocks = [block for block in mesh.cells if block.dim == 3]
    kinds = list(dict.fromkeys(block.type for block in blocks))
    known = ", ".join(_KINDS)
    if not kinds or not sum(len(block) for block in blocks):
        raise ValueError(f"has no volume elements; must have some of one kind, {known}")
    if len(kinds) > 1:
        raise ValueError(f"mixes {' and '.join(kinds)}; must have elements of one kind")
    (kind,) = kinds
    if kind not in _KINDS:
        raise ValueError(f"is made of {kind}; must be one of {known}")
    cells = np.concatenate([np.asarray(block.data, dtype=int) for block in blocks])
    if cells.min() < 0 or cells.max() >= len(mesh.points):
        raise ValueError("an element names a node that is not there")
    return cells


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


def _read_abaqus(path: str) -> meshio.Mesh:
    """Read the mesh of one part, without what meshio silently misreads."""
    lines = Path(path).read_text(encoding="utf-8", errors="replace").splitlines()
    keywords = [line.partition(",")[0].strip().upper() for line in lines]
    if keywords.count("*NODE") > 1:
        raise ValueError(f"has {keywords.count('*NODE')} blocks *NODE; must have all nodes in one")
    for keyword, wanted in (("*INSTANCE", "the mesh of one part"), ("*INCLUDE", "in one file")):
        if keyword in keywords:
            raise ValueError(f"has {keyword}; must be {wanted}")
    sets = []
    for number, keyword in enumerate(keywords):
        if keyword == "*ELEMENT":
            lines[number] = re.sub(r"(?i)(\btype\s*=\s*)(\w+)", _type_in_meshio, lines[number])
            name = re.search(r"(?i)\belset\s*=\s*([^,]+)", lines[number])
            sets.append(name[1].strip() if name else None)
    mesh = meshio.abaqus.read(io.StringIO("\n".join([*lines, ""])))
    for name in filter(None, sets):  # meshio takes the n-th set for that of the n-th block
        mesh.cell_sets[name] = [
            np.arange(len(block)) if of == name else np.array([], dtype=int)
            for block, of in zip(mesh.cells, sets, strict=True)
        ]
    return mesh


def _type_in_meshio(match: re.Match) -> str:
    kind = match[2].upper()
    return match[1] + _NAMES_IN_MESHIO.get(kind, kind)


READERS = dict(zip(origin.MESH_SUFFIXES, (_read_abaqus, meshio.gmsh.read, meshio.vtu.read), strict=True))
