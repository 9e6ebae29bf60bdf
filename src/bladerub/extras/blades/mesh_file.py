"""The content of a mesh file: nodes, one kind of quadratic element, node sets."""

import io
import itertools
import logging
import re
from collections import Counter
from contextlib import redirect_stderr
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from bladerub.blade.surface import EDGES
from bladerub.extras.blades import origin
from bladerub.io.errors import refuse_content
from bladerub.io.optional import package

meshio = package("meshio", "mesh")

log = logging.getLogger(__name__)

_LOOKED_THROUGH = 4000  # characters, for the first line
_NAMES_IN_MESHIO = {
    **dict.fromkeys(("CPS6", "S6", "M3D6", "SFM3D6"), "STRI65"),
    **dict.fromkeys(("CPS8", "CPS8R", "CPE8", "CPE8R", "S8", "M3D8", "M3D8R", "SFM3D8"), "S8R"),
    **dict.fromkeys(("CPE3", "M3D3", "SFM3D3"), "CPS3"),
    **dict.fromkeys(("CPE4", "CPE4R", "M3D4", "M3D4R", "SFM3D4"), "CPS4"),
}  # of the elements of surfaces that Gmsh and others write in Abaqus files

_STARTS = {
    **dict.fromkeys(("*NODE", "*HEADING", "*PART"), ".inp"),
    "$MESHFORMAT": ".msh",
    "<VTKFILE": ".vtu",
    "# VTK DATAFILE": ".vtk",
    **dict.fromkeys(("SOL ", "CEND", "BEGIN BULK", "GRID"), ".bdf"),
}  # first words of files, and how their names end

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
    volume_sets: list[str]  # names of sets of volume elements
    is_raised: bool  # whether elements of 8 or 4 nodes got nodes in the middle of their edges


def read(path: str | Path) -> MeshFile:
    """Read the mesh at `path`; a ValueError says why it cannot be used.

    Elements of 8 and 4 nodes, far too stiff in bending, become such of 20 and 10 with straight edges.
    """
    path = Path(path)
    origin.check_file(path)
    suffix = path.suffix.lower()
    _check_start(path)
    warnings = io.StringIO()
    try:
        with redirect_stderr(warnings):  # where meshio prints them
            mesh = READERS[suffix](str(path))
    except Exception as error:  # readers of foreign files raise all kinds of errors
        if isinstance(error, KeyError) and str(error.args[0]).startswith(("wedge", "pyramid", "hexahedron")):
            raise ValueError(_unusable(error.args[0])) from error  # meshio knows the kind by name only
        refuse_content(path, error)
    cells = _volume(mesh)
    points = np.asarray(mesh.points, dtype=float)
    if points.shape[1:] != (3,):
        raise ValueError("nodes must have three coordinates")
    is_linear = cells.shape[1] < 10
    if is_linear:
        points, cells = raised(points, cells)
    if warnings.getvalue():
        log.warning("%s: %s", path, " ".join(warnings.getvalue().split()))
    return MeshFile(points, cells, _node_sets(mesh), _volume_sets(mesh), is_linear)


def _check_start(path: Path) -> None:
    """Raise ValueError if a file begins as one of another program."""
    with path.open(encoding="utf-8", errors="replace") as stream:
        lines = (line.strip() for line in stream.read(_LOOKED_THROUGH).splitlines())
    first = next((line for line in lines if line and not line.startswith(("**", "$ ", "<?xml"))), "")
    for start, suffix in _STARTS.items():
        if first.upper().startswith(start) and suffix != path.suffix.lower():
            cure = origin.conversion(path, suffix)
            raise ValueError(f"begins with {first[: len(start)]}, as a {suffix} file does: {cure}")


def raised(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Add nodes in the middle of all edges of hexahedra (n, 8) or tetrahedra (n, 4)."""
    ends = np.sort(cells[:, EDGES[{8: 20, 4: 10}[cells.shape[1]]]], axis=-1)
    edges, edge = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    middle = len(points) + edge.reshape(len(cells), -1)
    return np.vstack([points, points[edges].mean(axis=1)]), np.hstack([cells, middle])


def _volume(mesh: meshio.Mesh) -> np.ndarray:
    blocks = [block for block in mesh.cells if block.dim == 3]
    kinds = list(dict.fromkeys(block.type for block in blocks))
    choices = ", ".join(_KINDS)
    if not kinds or not sum(len(block) for block in blocks):
        raise ValueError(f"has no volume elements; must have some of one kind, {choices}")
    if len(kinds) > 1 or kinds[0] not in _KINDS:
        raise ValueError(_unusable(*kinds))
    cells = np.concatenate([np.asarray(block.data, dtype=int) for block in blocks])
    if cells.min() < 0 or cells.max() >= len(mesh.points):
        raise ValueError("an element names a node that is not there")
    return cells


def _unusable(*kinds: str) -> str:
    """Say why elements of `kinds` of meshio cannot be used, and what to do."""
    return (
        f"{'mixes' if len(kinds) > 1 else 'has'} {' and '.join(kinds)}; must have elements of one kind, "
        f"{', '.join(_KINDS)}: split wedges and pyramids into tetrahedra, and hexahedra then too"
    )


def _volume_sets(mesh: meshio.Mesh) -> list[str]:
    groups = [name for name, (_, dimension) in mesh.field_data.items() if dimension == 3]
    return groups + [
        name
        for name, members in mesh.cell_sets.items()
        if any(
            block.dim == 3 and rows is not None and len(rows)
            for block, rows in zip(mesh.cells, members, strict=False)
        )
    ]


def _node_sets(mesh: meshio.Mesh) -> dict[str, np.ndarray]:
    sets = {name: [np.asarray(nodes, dtype=int)] for name, nodes in mesh.point_sets.items()}
    for name, values in mesh.point_data.items():
        if values.ndim == 1 and values.dtype.kind in "iub":
            sets.setdefault(name, []).append(np.flatnonzero(values))
    for name, (tag, dimension) in mesh.field_data.items():  # Gmsh counts tags anew in each dimension
        for block, physical in zip(mesh.cells, mesh.cell_data.get("gmsh:physical", []), strict=False):
            if block.dim == dimension < 3:
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
    if "*INSTANCE" in keywords:
        raise ValueError("has *INSTANCE; must be the mesh of one part")
    if "*INCLUDE" in keywords:
        includes = [
            line.split("=")[-1].strip()
            for line, keyword in zip(lines, keywords, strict=True)
            if keyword == "*INCLUDE"
        ]
        raise ValueError(
            "has *INCLUDE; must be in one file: "
            f"(cat {' '.join(includes)}; grep -vi '^\\*include' {Path(path).name}) > whole.inp"
        )
    sets, parts = [], {}
    for number, keyword in enumerate(keywords):
        if keyword == "*ELEMENT":
            lines[number] = re.sub(r"(?i)(\btype\s*=\s*)(\w+)", _type_in_meshio, lines[number])
            name = re.search(r"(?i)\belset\s*=\s*([^,]+)", lines[number])
            sets.append(name[1].strip() if name else None)
        if keyword == "*NSET" and (name := re.search(r"(?i)\bnset\s*=\s*([^,]+)", lines[number])):
            names = parts.setdefault(name[1].strip().upper(), [])
            names.append(f"{name[1].strip()}{chr(0) * len(names)}")  # each block by a name of its own
            lines[number] = lines[number].replace(name[1], names[-1])
    mesh = meshio.abaqus.read(io.StringIO("\n".join([*lines, ""])))
    for name in filter(None, sets):  # meshio takes the n-th set for that of the n-th block
        mesh.cell_sets[name] = [
            np.arange(len(block)) if set_name == name else np.array([], dtype=int)
            for block, set_name in zip(mesh.cells, sets, strict=True)
        ]
    for first, *others in parts.values():  # meshio keeps the last block of a name, Abaqus adds them up
        mesh.point_sets[first] = np.concatenate([mesh.point_sets.pop(name) for name in (first, *others)])
    return mesh


def _read_gmsh(path: str) -> meshio.Mesh:
    """Read a mesh whose physical groups have each a name of its own, as meshio looks them up by it."""
    with Path(path).open(encoding="utf-8", errors="replace") as stream:
        head = itertools.takewhile(lambda line: line.strip() not in ("$EndPhysicalNames", "$Nodes"), stream)
        names = re.findall(r'^\d+ +\d+ +"(.*)"\s*$', "".join(head), re.MULTILINE)
    twice = [name for name, count in Counter(names).items() if count > 1]
    if twice:
        raise ValueError(f"has several physical groups {twice[0]}; each must have a name of its own")
    return meshio.gmsh.read(path)


def _type_in_meshio(match: re.Match) -> str:
    kind = match[2].upper()
    return match[1] + _NAMES_IN_MESHIO.get(kind, kind)


READERS = dict(zip(origin.MESH_SUFFIXES, (_read_abaqus, _read_gmsh, meshio.vtu.read), strict=True))
