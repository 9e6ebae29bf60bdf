"""Where a blade comes from: ``blade.source`` of the config, unit and axes of its files, and their faults.

The blade's frame (`bladerub.blade.geometry`) has x along the engine axis, z along the blade, and a rotation
that takes z towards y: by the right-hand rule, about -x. A file whose axes are named is therefore only
turned, never mirrored, with x against its rotation vector. So x points downstream or upstream, depending on
the blade, and the leading edge may have the smaller or the larger x.
"""

import errno
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, NoReturn

import numpy as np

from bladerub.extras.blades.settings import Source
from bladerub.extras.cells import UNITS
from bladerub.io.errors import BadInput, format_value, is_refused
from bladerub.io.folders import study_folder

LENGTHS = (0.01, 3.0)  # limits of the length of a blade, m, as those of ``blade.length`` of the config
FARTHEST = 1e9  # coordinate in any unit; beyond 1e154 squares overflow
MESH_SUFFIXES = (".inp", ".msh", ".vtu")
CONVERSION = "meshio convert makes .vtu of other meshes, gmsh -3 -order 2 a .msh of a solid (.step, .iges)"
TABLE_SUFFIXES = (".csv", ".txt", ".dat")  # of tables of sections; all other files are meshes


@dataclass(frozen=True)
class Frame:
    """Unit (of `UNITS`) and axes of a file; its engine axis passes through its origin.

    Raises ValueError if `downstream` is not along the engine axis or `radial` is not across it.
    """

    unit: str = "m"
    rotation: str = "-x"  # about which the blade turns by the right-hand rule
    downstream: str = "x"  # along which the air flows
    radial: str = "z"  # from root to tip

    def __post_init__(self):
        axis = self.rotation[-1]
        if self.downstream[-1] != axis:
            rule = f"must be along the axis of rotation, {axis} or -{axis}"
            raise ValueError(f"downstream = {self.downstream}: {rule}")
        if self.radial[-1] == axis:
            raise ValueError(f"radial = {self.radial}: must not be the axis of rotation")

    @property
    def turn(self) -> np.ndarray:
        """Rotation matrix (3, 3) from the file's axes to the blade's."""
        x, z = -_vector(self.rotation), _vector(self.radial)
        return np.stack([x, np.cross(z, x), z])

    @property
    def downstream_x(self) -> int:
        """1 where the blade's x points downstream, -1 where it points upstream."""
        return -1 if self.downstream == self.rotation else 1

    def check_length(self, length: float) -> None:
        """Check that `length` (m) is one of a blade, or raise ValueError: the unit is wrong."""
        shortest, longest = LENGTHS
        if not shortest <= length <= longest:
            limits = f"must be from {shortest:g} to {longest:g} m"
            raise ValueError(f"with the unit {self.unit} the blade is {length:.4g} m long; {limits}")

    def metres(self, points: np.ndarray) -> np.ndarray:
        """Convert points (n, 3) of the file to the blade's frame, m."""
        return UNITS[self.unit] * points @ self.turn.T

    def cartesian(self, z: np.ndarray, r: np.ndarray, theta: np.ndarray) -> np.ndarray:
        """Turn cylindrical coordinates of the file (n,) into its Cartesian ones (n, 3).

        `z` counts along the engine axis in the positive direction of its letter, whichever sign `rotation`
        has; `theta` (rad) counts about that direction by the right-hand rule, from `radial` on. So the blade
        turns towards larger angles where `rotation` is x, y or z, to smaller ones where it is -x, -y or -z.
        """
        axis, radial = _vector(self.rotation[-1]), _vector(self.radial)
        around = np.cross(axis, radial)
        z, r, theta = z[:, None], r[:, None], theta[:, None]
        return z * axis + r * (np.cos(theta) * radial + np.sin(theta) * around)


def _vector(axis: str) -> np.ndarray:
    return (-1.0 if axis.startswith("-") else 1.0) * np.eye(3)["xyz".index(axis[-1])]


_OF_FRAME = tuple(asdict(Frame()))
# keys that go with a kind of source, beside ``tip_cone`` and those of the frame
_KEYS = {
    "matrices": ("matrices", "matrix_units", "omega_max"),
    "a mesh": ("file", "root_set", "tip_set"),
    "a table of sections": ("file", "angle_unit"),
}


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
    """Check that the keys of a source go together; a ValueError begins with the key that does not."""
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
