"""Where a blade comes from: the ``blade.source`` block of the config, and faults of its files."""

import errno
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any, NoReturn

from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.settings import Source
from bladerub.io.errors import BadInput, format_value, is_refused
from bladerub.io.folders import study_folder

MATRIX_UNITS = {"SI": 1.0, "mm-tonne": 1e3, "inch-lbf": 4.4482216152605 / 0.0254}
"""N/m of the stiffness, and equally kg of the mass, by the name of a system of units with the second in it.

As the two are equal, frequencies do not show when the wrong system is named.
"""
MESH_SUFFIXES = (".inp", ".msh", ".vtu")
CONVERSION = "meshio convert makes .vtu of other meshes, gmsh -3 -order 2 a .msh of a solid (.step, .iges)"
TABLE_SUFFIXES = (".csv", ".txt", ".dat")  # of tables of sections; all other files are meshes
_OF_FRAME = tuple(asdict(Frame()))
_KEYS = {
    "matrices": ("matrices", "matrix_units", "omega_max"),
    "a mesh": ("file", "root_set", "tip_set"),
    "a table of sections": ("file", "angle_unit"),
}
"""Keys that go with a kind of source, beside ``tip_cone`` and those of the frame."""


def path(source: Source) -> Path:
    """Return the file or folder of the ``blade.source`` block of a config, which names it from the study."""
    return study_folder() / (source.matrices or source.file)


def frame(source: Source) -> Frame:
    """Return unit and axes of a source; raises ValueError as `Frame`."""
    return Frame(**{key: value for key, value in source.plain().items() if key in _OF_FRAME})


def is_table(source: Source) -> bool:
    """Return whether it is a table of sections, which is meshed here, by ``blade.mesh`` of the config."""
    return not source.matrices and Path(source.file).suffix.lower() in TABLE_SUFFIXES


def check(source: Source) -> None:
    """Check that the keys of a source go together.

    A ValueError begins with the key if neither ``file`` nor ``matrices`` is there, of what does not go with
    this kind of source, and of a frame that cannot be.
    """
    if not (source.matrices or source.file):
        raise ValueError("file: missing; must be given, or matrices in its place")
    kind = "matrices" if source.matrices else "a table of sections" if is_table(source) else "a mesh"
    for key, value in source.plain().items():
        if key not in ("tip_cone", *_OF_FRAME, *_KEYS[kind]):
            raise ValueError(f"{key} = {value}: must not be given beside {kind}")
    frame(source)


def problems(source: Source, files: Callable[[Source], list[str]]) -> Iterator[str]:
    """Yield what is wrong with the keys of a source, or with its `files`."""
    try:
        check(source)
    except ValueError as error:
        yield f"blade.source.{error}"
        return
    try:
        if not path(source).exists():
            raise ValueError("there is no such file or folder")
        files(source)
    except ValueError as error:
        key = "matrices" if source.matrices else "file"
        yield f"blade.source.{key} = {format_value(getattr(source, key))}: {error} ({path(source)})"


def settings(source: Source) -> dict[str, Any]:
    """Return the block of a source with what it may leave out: that makes no other blade."""
    return asdict(Frame()) | source.plain()


def check_file(path: Path) -> None:
    """Check the name of a mesh or table, and that it is there; a ValueError says what is wrong."""
    if path.suffix.lower() not in (*MESH_SUFFIXES, *TABLE_SUFFIXES):
        raise ValueError(
            f"must be a mesh file that ends in {', '.join(MESH_SUFFIXES)}, or a table of sections in "
            f"{', '.join(TABLE_SUFFIXES)}; {CONVERSION}"
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


@contextmanager
def naming(*paths: Path) -> Iterator[None]:
    """Add `paths` to the message of a ValueError, which becomes a BadInput."""
    try:
        yield
    except ValueError as error:
        raise BadInput(f"{' and '.join(map(str, paths))}: {error}") from error
