"""Tables of blade sections, as text: a row for each station of a section, from the leading edge on.

The names of the columns, in capital or small letters, show which of two forms a table has. In both, `section`
names the section, hub to tip; other columns are ignored. How cells are separated and numbers written is for
`bladerub.extras.cells`.

- Points of the surface: x, y and z of one side (`x1`, `y1`, `z1`) and of the other (`x2`, `y2`, `z2`).
- As compressor rotors are published: axial position `z` and radius `r`, and at both the angles `theta1` and
  `theta2` of the two sides (`bladerub.extras.blades.frame.Frame.cartesian` defines their origin and sign).
"""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.extras.blades import section_text
from bladerub.extras.blades.frame import Frame
from bladerub.extras.blades.section_text import POINTS
from bladerub.extras.file_units import ANGLE_UNITS

STATIONS = (5, 2000)  # fewest and most of a section


@dataclass(frozen=True)
class Section:
    """A section of a table."""

    name: str
    lines: np.ndarray = field(repr=False)  # (n,), line of the file of each station
    points: np.ndarray = field(repr=False)  # (2, n, 3), both sides from the leading edge, blade's frame, m


def read(path: str | Path, frame: Frame, angle_unit: str = "rad") -> list[Section]:
    """Read the sections of a table in the order of the file; a ValueError names a line or section."""
    table, form = section_text.read(Path(path))
    numbers = pd.DataFrame({name: table.numbers(name) for name in form}, index=[*table.rows])
    names = pd.Series(table.column("section"), index=numbers.index)
    if (names == "").any():
        raise ValueError(f"line {(names == '').idxmax()}: has no section")
    parts = numbers.groupby((names != names.shift()).cumsum())
    sections = [_section(names[rows.index[0]], rows, frame, angle_unit) for _, rows in parts]
    _check_names(sections)
    return sections


def _section(name: str, rows: pd.DataFrame, frame: Frame, angle_unit: str) -> Section:
    lines = rows.index.to_numpy()
    label = f"section {name} (line {lines[0]})"
    minimum, maximum = STATIONS
    if not minimum <= len(rows) <= maximum:
        raise ValueError(
            f"{label}: has {len(rows)} stations; must have {minimum} to {maximum} in successive rows"
        )
    if "r" in rows:
        if (rows.r <= 0).any():
            line = (rows.r <= 0).idxmax()
            raise ValueError(f"line {line}: r = {rows.r[line]:g}, must be above 0")
        angles = ANGLE_UNITS[angle_unit] * rows[["theta1", "theta2"]].to_numpy().T
        if np.ptp(angles) > np.pi:
            raise ValueError(
                f"{label}: its angles go over {np.ptp(angles):.3g} rad, more than half around the axis; are "
                f"they in {angle_unit}?"
            )
        sides = [frame.cartesian(rows.z.to_numpy(), rows.r.to_numpy(), theta) for theta in angles]
    else:
        sides = [rows[list(side)].to_numpy() for side in (POINTS[:3], POINTS[3:])]
    return Section(name, lines, np.stack([frame.metres(side) for side in sides]))


def _check_names(sections: list[Section]) -> None:
    if len(sections) < 2:
        raise ValueError(f"has {len(sections)} section; must have two or more, from hub to tip")
    sections_by_name = {}
    for section in sections:
        if (first := sections_by_name.setdefault(section.name, section)) is not section:
            raise ValueError(
                f"line {section.lines[0]}: section {section.name} comes back; all its stations must follow "
                f"line {first.lines[0]}"
            )
