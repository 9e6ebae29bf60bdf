"""The content of a mesh file: nodes, one kind of quadratic element, node sets."""

import codecs
import io
import logging
import re
from collections import Counter
from contextlib import redirect_stderr
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bladerub.extras.blade_meshes import EDGES
from bladerub.extras.blades import deck_mesh, origin
from bladerub.extras.blades.deck_mesh import Content
from bladerub.io.errors import package

meshio = package("meshio", "mesh")
log = logging.getLogger(__name__)

_LOOKED_THROUGH = 4000  # bytes, for the first line
# first words of files, and how their names end
_STARTS = {"$MESHFORMAT": ".msh", "<VTKFILE": ".vtu"}
_STARTS |= dict.fromkeys(("*NODE", "*HEADING", "*PART"), ".inp")
_ENDS = {".msh": "$End", ".vtu": "</VTKFile>"}
_KINDS = ("hexahedron20", "tetra10", "hexahedron", "tetra")  # in meshio; of the last two, quadratic are made


class MeshFile(NamedTuple):
    """The content of a mesh file."""

    points: np.ndarray  # (n_points, 3), in unit and axes of the file, then those added
    cells: np.ndarray  # (n_elements, 20 or 10), in the order of CalculiX and VTK
    # node sets and sets of surface elements of Abaqus, physical groups of surfaces, lines and points of Gmsh,
    # and whole-numbered point data of VTK (nodes where it is not zero)
    node_sets: dict[str, np.ndarray]
    volume_sets: list[str]  # names of sets of volume elements
    is_raised: bool  # whether elements of 8 or 4 nodes got nodes in the middle of their edges


def read(path: Path) -> MeshFile:
    """Read a mesh, or say in a ValueError why not; linear elements, too stiff, get mid-side nodes."""
    origin.check_file(path)
    _check_ends(path)
    content = deck_mesh.read(path) if path.suffix.lower() == ".inp" else _read_by_meshio(path)
    cells = _volume(content)
    points = np.asarray(content.points, dtype=float)
    if points.shape[1:] != (3,):
        raise ValueError("nodes must have three coordinates")
    is_linear = cells.shape[1] < 10
    if is_linear:
        points, cells = raised(points, cells)
    return MeshFile(points, cells, content.node_sets, content.volume_sets, is_linear)


def _read_by_meshio(path: Path) -> Content:
    warnings = io.StringIO()
    try:
        with redirect_stderr(warnings):  # where meshio prints them
            mesh = _READERS[path.suffix.lower()](str(path))
    except Exception as error:  # readers of foreign files raise all kinds of errors
        origin.refuse_content(path, error)
    if warnings.getvalue():
        log.warning("%s: %s", path, " ".join(warnings.getvalue().split()))
    solids: dict[str, list[np.ndarray]] = {}
    for block in mesh.cells:
        if block.dim == 3 and len(block):
            solids.setdefault(block.type, []).append(np.asarray(block.data, dtype=int))
    cells = {kind: np.concatenate(blocks) for kind, blocks in solids.items()}
    for kind, nodes in cells.items():  # Gmsh has an element again for each of its physical groups
        cells[kind] = nodes[np.sort(np.unique(nodes, axis=0, return_index=True)[1])]
    volume_sets = [name for name, (_, dimension) in mesh.field_data.items() if dimension == 3]
    return Content(mesh.points, cells, _node_sets(mesh), volume_sets)


def _check_ends(path: Path) -> None:
    """Raise ValueError if a file begins as one of another program, or one of Gmsh or VTK is cut off."""
    content, ending = path.read_bytes().strip(), path.suffix.lower()
    if ending == ".msh" and content.startswith(codecs.BOM_UTF8):
        raise ValueError("begins with a byte order mark; save it as UTF-8 without one (BOM)")
    text = content[:_LOOKED_THROUGH].decode("utf-8", errors="replace")
    if "\0" in text and ending == ".inp":
        raise ValueError("is not text in UTF-8; save it as such")
    lines = (line.strip() for line in text.splitlines())
    first = next((line for line in lines if line and not line.startswith(("**", "$ ", "<?xml"))), "")
    for start, suffix in _STARTS.items():
        if first.upper().startswith(start) and suffix != ending:
            cure = f"rename it to {path.stem}{suffix}"
            raise ValueError(f"begins with {first[: len(start)]}, as a {suffix} file does: {cure}")
    end = _ENDS.get(ending, "")
    if end.encode() not in content.rpartition(b"\n")[2]:
        raise ValueError(f"does not end with {end}: it is cut off, or no {ending} file")


def raised(points: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Add nodes in the middle of all edges of hexahedra (n, 8) or tetrahedra (n, 4)."""
    ends = np.sort(cells[:, EDGES[{8: 20, 4: 10}[cells.shape[1]]]], axis=-1)
    edges, edge = np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)
    middle = len(points) + edge.reshape(len(cells), -1)
    return np.vstack([points, points[edges].mean(axis=1)]), np.hstack([cells, middle])


def _volume(content: Content) -> np.ndarray:
    choices = ", ".join(_KINDS)
    if not content.solids:
        raise ValueError(f"has no volume elements; must have some of one kind, {choices}")
    (kind, cells), *others = content.solids.items()
    if kind == "hexahedron27" and not others:
        cells = cells[:, :20]  # without the nodes in the middle of faces and of the element
    elif others or kind not in _KINDS:
        raise ValueError(
            f"{'mixes' if others else 'has'} {' and '.join(content.solids)}; must have elements of one kind, "
            f"{choices}: split wedges and pyramids into tetrahedra, and hexahedra then too"
        )
    if cells.min() < 0 or cells.max() >= len(content.points):
        raise ValueError("an element names a node that is not there")
    twice = len(cells) - len(np.unique(np.sort(cells, axis=1), axis=0))
    if twice:
        raise ValueError(f"{twice} elements have the same nodes as others; must be there once")
    return cells


def _node_sets(mesh: meshio.Mesh) -> dict[str, np.ndarray]:
    sets = {
        name: [np.flatnonzero(values)]
        for name, values in mesh.point_data.items()
        if values.ndim == 1 and (values.dtype.kind in "iub" or np.isin(values, (0, 1)).all())
    }
    for name, (tag, dimension) in mesh.field_data.items():  # Gmsh counts tags anew in each dimension
        groups = mesh.cell_data.get("gmsh:physical", [])  # the first of each element; cell_sets has all
        members = mesh.cell_sets.get(name) or [tags == tag for tags in groups]
        for block, rows in zip(mesh.cells, members, strict=False):
            if block.dim == dimension < 3:
                sets.setdefault(name, []).append(np.ravel(block.data[rows]))
    merged = {name: np.unique(np.concatenate(nodes)) for name, nodes in sets.items()}
    return {name: nodes for name, nodes in merged.items() if nodes.size}


def _read_gmsh(path: str) -> meshio.Mesh:
    """Read a mesh whose physical groups have each a name of its own, as meshio looks them up by it."""
    head = Path(path).read_bytes().partition(b"$Nodes")[0].decode(errors="replace")
    names = Counter(re.findall(r'^\s*\d+\s+\d+\s+"(.*)"', head, re.MULTILINE))
    if twice := [name for name, count in names.items() if count > 1]:
        raise ValueError(f"has several physical groups {twice[0]}; each must have a name of its own")
    if "$PartitionedEntities" in head:
        raise ValueError("is partitioned; unpartition it in Gmsh, and save it again")
    try:
        return meshio.gmsh.read(path)
    except (meshio.ReadError, ValueError) as error:
        if "parametric" in str(error):
            reason = "nodes have parameters; save in version 4.1 without Mesh.SaveParametric"
        elif "gmsh:physical" in str(error):
            reason = "elements of some entities are in no physical group; save without Mesh.SaveAll"
        elif str(error):
            raise
        else:
            reason = "no mesh of Gmsh, damaged, or binary of another machine: save as text, Mesh.Binary = 0"
        raise ValueError(reason) from error


_READERS = {".msh": _read_gmsh, ".vtu": meshio.vtu.read}
