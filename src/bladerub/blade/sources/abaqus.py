"""Abaqus and CalculiX files through meshio, except what it would silently misread."""

import io
import re
from pathlib import Path

import meshio
import numpy as np

_AS_MESHIO_KNOWS_THEM = {
    **dict.fromkeys(("CPS6", "S6", "M3D6", "SFM3D6"), "STRI65"),
    **dict.fromkeys(("CPS8", "CPS8R", "CPE8", "CPE8R", "S8", "M3D8", "M3D8R", "SFM3D8"), "S8R"),
    **dict.fromkeys(("CPE3", "M3D3", "SFM3D3"), "CPS3"),
    **dict.fromkeys(("CPE4", "CPE4R", "M3D4", "M3D4R", "SFM3D4"), "CPS4"),
}
"""What meshio calls the elements of surfaces that Gmsh and others write."""


def read(path: str | Path) -> meshio.Mesh:
    """Read the mesh of one part; ValueError if there are several, or several blocks of nodes or files."""
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
            lines[number] = re.sub(r"(?i)(\btype\s*=\s*)(\w+)", _type, lines[number])
            name = re.search(r"(?i)\belset\s*=\s*([^,]+)", lines[number])
            sets.append(name[1].strip() if name else None)
    mesh = meshio.abaqus.read(io.StringIO("\n".join([*lines, ""])))
    for name in filter(None, sets):  # meshio takes the n-th set for that of the n-th block
        mesh.cell_sets[name] = [
            np.arange(len(block)) if of == name else np.array([], dtype=int)
            for block, of in zip(mesh.cells, sets, strict=True)
        ]
    return mesh


def _type(match: re.Match) -> str:
    kind = match[2].upper()
    return match[1] + _AS_MESHIO_KNOWS_THEM.get(kind, kind)
