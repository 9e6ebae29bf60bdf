"""A casing whose gap was measured around it, as a table (`bladerub.study.grid`)."""

import math
from functools import lru_cache
from pathlib import Path

import numpy as np

from bladerub.contact.casing import shape
from bladerub.contact.spec import Casing
from bladerub.extras import cells
from bladerub.extras.casings.settings import MeasuredCasing
from bladerub.extras.cells import ANGLE_UNITS, UNITS
from bladerub.io.folders import study_folder

MEASURED_ANGLES = (8, 10_000)  # fewest and most of a measured gap
_WIDEST_STEP = np.pi / 2  # rad, between angles of a measured gap: from there on an oval is not resolved
_UNEVEN = 4.0  # widest step over the next; beyond, a part of the turn is missing
_HIGHEST_HARMONIC = 100
_MARKED = 0.1  # of the largest harmonic: those of a measured shape from there on count as nodal diameters


def casing_spec(name: str, entry: MeasuredCasing, length_scale: float) -> Casing:
    """Describe an entry of ``casings``, SI; a ValueError begins with the key of a table that is none."""
    table, interference = entry.table, entry.interference
    path = study_folder() / table.file
    units = UNITS[table.unit or "m"], ANGLE_UNITS[table.angle_unit or "deg"]
    try:
        version = path.stat().st_mtime_ns if path.is_file() else 0
        angle, gap = _measured(path, version, *units)
    except ValueError as error:
        raise ValueError(f"table.file = {table.file}: {error}") from error
    amplitude, lowest = float(np.ptp(gap)), float(np.min(gap))
    inward = (np.max(gap) - gap) / amplitude
    # the measured gap is taken as it is, or shifted to the interference that stands beside the table
    interference = -lowest if interference is None else float(interference * length_scale)
    measured = tuple(zip(angle.tolist(), inward.tolist(), strict=True))
    return Casing(name, (), (), amplitude, interference, math.radians(entry.start_angle), measured=measured)


def nodal_diameters(entry: MeasuredCasing) -> list[int]:
    """List the harmonics of the shape of at least a tenth of the largest."""
    angle = np.linspace(0, 2 * np.pi, 4 * _HIGHEST_HARMONIC, endpoint=False)
    size = np.abs(np.fft.rfft(shape(casing_spec("", entry, 1.0), angle)))[1 : _HIGHEST_HARMONIC + 1]
    return [n for n, of_n in enumerate(size, 1) if of_n >= _MARKED * np.max(size)]


@lru_cache
def _measured(path: Path, _version: int, unit: float, angle_unit: float) -> tuple[np.ndarray, np.ndarray]:
    """Angles (rad) and gaps (m) of a table; `_version` makes an edited file another one."""
    table = cells.read(path)
    table.require("angle", "gap")
    angle = angle_unit * table.numbers("angle")
    gap = unit * table.numbers("gap")
    lines = list(table.rows)
    turn = 2 * np.pi * (1 - 1e-9)
    if len(angle) > 1 and angle[-1] - angle[0] >= turn and gap[-1] == gap[0]:
        angle, gap = angle[:-1], gap[:-1]  # the last row is the first again
    minimum, maximum = MEASURED_ANGLES
    if not minimum <= len(angle) <= maximum:
        raise ValueError(f"has {len(angle)} angles; must have {minimum} to {maximum}")
    if (back := np.diff(angle) <= 0).any():
        raise ValueError(f"line {lines[back.argmax() + 1]}: angle must be above that of the row before")
    if angle[-1] - angle[0] >= turn:
        rule = "must stay within a turn, without a row that repeats the first angle"
        raise ValueError(f"goes over {np.rad2deg(angle[-1] - angle[0]):g} degrees; {rule}")
    if np.ptp(gap) == 0:
        raise ValueError(f"has the same gap everywhere, {gap[0]:g} m; must vary")
    steps = np.diff(angle, append=angle[0] + 2 * np.pi)
    widest = np.argmax(steps)
    if steps[widest] >= _WIDEST_STEP or steps[widest] > _UNEVEN * np.partition(steps, -2)[-2]:
        step, start = np.rad2deg(steps[widest]), np.rad2deg(angle[widest])
        is_rad = np.rad2deg(angle[-1] - angle[0]) <= 2 * np.pi
        raise ValueError(
            f"line {lines[widest]}: no angle for {step:g} degrees after {start:g}; must go around the casing "
            f"in steps below {np.rad2deg(_WIDEST_STEP):g} degrees, none {_UNEVEN:g} times as wide as the next"
            f"{'; are the angles in rad (angle_unit)?' if is_rad else ''}"
        )
    order = np.argsort(angle % (2 * np.pi))
    return (angle % (2 * np.pi))[order], gap[order]
