"""Where a blade comes from: the ``blade.source`` block of the config, and faults of its files."""

import errno
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn

from bladerub.extras.blades.frame import Frame
from bladerub.io.errors import is_refused
from bladerub.io.folders import study_folder
from bladerub.io.optional import package

if TYPE_CHECKING:
    from bladerub.extras.blades import settings

MATRIX_UNITS = {"SI": 1.0, "mm-tonne": 1e3, "inch-lbf": 4.4482216152605 / 0.0254}
"""N/m of the stiffness, and equally kg of the mass, by the name of a system of units with the second in it.

As the two are equal, frequencies do not show when the wrong system is named.
"""
MESH_SUFFIXES = (".inp", ".msh", ".vtu")
_BY_GMSH = {".unv": "-save", **dict.fromkeys((".stp", ".step", ".igs", ".iges", ".brep"), "-3 -order 2")}
TABLE_SUFFIXES = (".csv", ".txt", ".dat")  # of tables of sections; all other files are meshes


@dataclass(frozen=True)
class Source:
    """A mesh (`bladerub.extras.blades.mesh_file`) or table of sections that a blade comes from.

    What is not given is found: the node sets by the direction of the surface, the cone by a fit to the tip.
    Raises ValueError if something is given that does not apply to this kind of file.
    """

    file: Path
    frame: Frame = field(default_factory=Frame)
    root_set: str | None = None
    tip_set: str | None = None
    tip_cone: float | None = None  # half angle of the flow path at the tip, degrees, positive: it widens
    angle_unit: str | None = None  # of a table, one of `bladerub.extras.cells.ANGLE_UNITS`; else rad

    def __post_init__(self):
        kind = "mesh" if self.is_table else "table of sections"
        for name in ("root_set", "tip_set") if self.is_table else ("angle_unit",):
            if (value := getattr(self, name)) is not None:
                raise ValueError(f"{name} = {value}: goes with a {kind}, not with {self.file.name}")

    @property
    def is_table(self) -> bool:
        """Whether the file is a table of sections, which is meshed here, by ``blade.mesh`` of the config."""
        return self.file.suffix.lower() in TABLE_SUFFIXES


@dataclass(frozen=True)
class MatrixSource:
    """A folder of matrices that a blade comes from (`bladerub.extras.blades.matrix_folder`)."""

    folder: Path
    frame: Frame = field(default_factory=Frame)  # unit of the coordinates, axes of nodes and matrices
    matrix_units: str = "SI"  # one of `MATRIX_UNITS`
    omega_max: float | None = None  # speed of ``stiffness_max``, rad/s, to check ``reduction.f_omega_max``
    tip_cone: float | None = None  # as in `Source`


def read(source: "settings.Source") -> Source | MatrixSource:
    """Read the ``blade.source`` block of the config, whose file or folder is relative to the study.

    Raises a ValueError that begins with the key if neither ``file`` nor ``matrices`` is there, or keys do not
    go together.
    """
    others = source.plain()
    path_key = next((name for name in ("matrices", "file") if name in others), None)
    if path_key is None:
        raise ValueError("file: missing; must be given, or matrices in its place")
    kind = MatrixSource if path_key == "matrices" else Source
    path = study_folder() / others.pop(path_key)
    frame = {entry.name: others.pop(entry.name) for entry in fields(Frame) if entry.name in others}
    names = [entry.name for entry in fields(kind)]
    for key in others:
        if key not in names:
            raise ValueError(f"{key} = {others[key]}: must not be given beside {path_key}")
    return kind(path, Frame(**frame), **others)


def conversion(path: Path, suffix: str) -> str:
    """Say how a file that ends in `suffix`, or should, becomes a mesh that is read."""
    if suffix in _BY_GMSH:
        return f"gmsh {path.name} {_BY_GMSH[suffix]} -o {path.stem}.msh"
    name = f"{path.stem}{suffix}"
    rename = "" if path.suffix.lower() == suffix else f"rename it to {name}"
    convert = "" if suffix in MESH_SUFFIXES else f"meshio convert {name} {path.stem}.vtu converts it"
    return ", then ".join(filter(None, (rename, convert)))


def check_file(path: Path) -> None:
    """Check the name of a mesh or table, and that it is there; a ValueError says what is wrong."""
    if path.suffix.lower() not in (*MESH_SUFFIXES, *TABLE_SUFFIXES):
        suffix = path.suffix.lower()
        cure = (
            f": {conversion(path, suffix)}"
            if suffix in {*package("meshio", "mesh").extension_to_filetypes, *_BY_GMSH}
            else ""
        )
        raise ValueError(
            f"must be a mesh file that ends in {', '.join(MESH_SUFFIXES)}, or a table of sections in "
            f"{', '.join(TABLE_SUFFIXES)}{cure}"
        )
    if not path.is_file():
        raise ValueError("there is no such file")
    if path.stat().st_size == 0:
        raise ValueError("is empty")


def refuse_content(path: Path, error: Exception) -> NoReturn:
    """Raise the `error` of a foreign reader: a ValueError of what it read, an OSError of the system."""
    if is_refused(error) and error.errno != errno.EINVAL:  # that is of offsets in damaged archives
        error.filename = error.filename or str(path)
        raise error
    reason = str(error) or type(error).__name__
    raise ValueError(f"is not a {path.suffix.lower()} file that can be read ({reason})") from error
