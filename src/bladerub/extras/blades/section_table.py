"""Tables of blade sections, as text: a row for each station of a section, from the leading edge on.

The names of the columns, in capital or small letters, show which of two forms a table has. In both, `section`
names the section, hub to tip; other columns are ignored. How cells are separated and numbers written is for
`bladerub.extras.cells`.

- Points of the surface: x, y and z of one side (`x1`, `y1`, `z1`) and of the other (`x2`, `y2`, `z2`).
- As compressor rotors are published: axial position `z` and radius `r`, and at both the angles `theta1` and
  `theta2` of the two sides (`bladerub.extras.blades.origin.Frame.cartesian` defines their origin and sign).
"""

from collections.abc import Mapping
from itertools import groupby
from pathlib import Path
from typing import NamedTuple

import numpy as np

from bladerub.extras import cells
from bladerub.extras.blades import origin
from bladerub.extras.blades.origin import Frame
from bladerub.extras.cells import ANGLE_UNITS, Cells

POINTS = ("x1", "y1", "z1", "x2", "y2", "z2")
CYLINDRICAL = ("z", "r", "theta1", "theta2")
STATIONS = (5, 2000)  # fewest and most of a section


class Section(NamedTuple):
    """A section of a table."""

    name: str
    lines: np.ndarray  # (n,), line of the file of each station
    points: np.ndarray  # (2, n, 3), both sides from the leading edge, blade's frame, m


def read(path: Path, frame: Frame, angle_unit: str = "rad") -> list[Section]:
    """Read the sections of a table in the order of the file; a ValueError names a line or section."""
    table, form = read_cells(path)
    numbers = {name: table.numbers(name) for name in form}
    names, lines = table.column("section"), np.array([*table.rows])
    if "" in names:
        raise ValueError(f"line {lines[names.index('')]}: has no section")
    sections: dict[str, Section] = {}
    for name, group in groupby(range(len(names)), names.__getitem__):
        rows = [*group]
        if name in sections:
            rule = f"all its stations must follow line {sections[name].lines[0]}"
            raise ValueError(f"line {lines[rows[0]]}: section {name} comes back; {rule}")
        values = {column: of_all[rows] for column, of_all in numbers.items()}
        label = f"section {name} (line {lines[rows[0]]})"
        sections[name] = Section(name, lines[rows], _points(label, lines[rows], values, frame, angle_unit))
    if len(sections) < 2:
        raise ValueError(f"has {len(sections)} section; must have two or more, from hub to tip")
    return [*sections.values()]


def read_cells(path: Path) -> tuple[Cells, tuple[str, ...]]:
    """Read a table and the columns of numbers of its form; a ValueError names a line, or what is missing."""
    origin.check_file(path)
    table = cells.read(path)
    columns = {name.lower() for name in table.names}
    form, other = sorted((POINTS, CYLINDRICAL), key=lambda form: len({*form} - columns))
    if columns.issuperset(other):
        raise ValueError(f"line {table.header}: has the columns of both forms; leave out {', '.join(other)}")
    try:
        table.require("section", *form)
    except ValueError as error:
        raise ValueError(f"{error}; or section, {', '.join(other)}") from error
    for name in ("section", *form):
        table.column(name)
    return table, form


def _points(label: str, lines: np.ndarray, values: Mapping, frame: Frame, angle_unit: str) -> np.ndarray:
    """Points (2, n, 3) of both sides of the section `label` of these `lines` of the file, m."""
    minimum, maximum = STATIONS
    if not minimum <= lines.size <= maximum:
        limits = f"must have {minimum} to {maximum} in successive rows"
        raise ValueError(f"{label}: has {lines.size} stations; {limits}")
    if "r" in values:
        z, radius = values["z"], values["r"]
        if (inside := radius <= 0).any():
            raise ValueError(f"line {lines[inside][0]}: r = {radius[inside][0]:g}, must be above 0")
        angles = ANGLE_UNITS[angle_unit] * np.stack([values["theta1"], values["theta2"]])
        if np.ptp(angles) > np.pi:
            fault = f"its angles go over {np.ptp(angles):.3g} rad, more than half around the axis"
            raise ValueError(f"{label}: {fault}; are they in {angle_unit}?")
        sides = [frame.cartesian(z, radius, theta) for theta in angles]
    else:
        sides = [np.stack([values[axis] for axis in side], axis=1) for side in (POINTS[:3], POINTS[3:])]
    return np.stack([frame.metres(side) for side in sides])
