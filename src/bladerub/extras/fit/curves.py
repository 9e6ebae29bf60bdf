"""Compressive stress-strain curves from a table: columns `strain`, `stress`, `rate`, perhaps `test`.

A unit stands behind the name of its column, in brackets: ``stress (MPa)``. The rows of a rate, or of a test
where that column is there, are one curve, in the order of loading. How cells are separated and numbers
written is for `bladerub.extras.cells`.
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bladerub.extras import cells
from bladerub.io.errors import BadInput

UNITS = {
    "strain": {"1": 1.0, "%": 0.01},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "rate": {"1/s": 1.0},
}
"""Units of each column, in SI."""
_DEFAULT = {"strain": "1", "rate": "1/s"}  # stress has none: Pa and MPa are both usual
_MOST = {"strain": 1.0, "stress": 1e12, "rate": 1e9}  # of a coating, in SI: beyond, the unit is another
FEWEST_ROWS, FEWEST_OF_CURVE = 5, 3
_HEADER = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*", re.DOTALL)


class Curve(NamedTuple):
    """A test at one rate."""

    rate: float  # Of strain, 1/s; 0 where the table has no rate
    strain: np.ndarray  # (n,): Compressive, in the order of loading
    stress: np.ndarray  # (n,): Compressive, Pa


def read(path: str | Path, units: Mapping[str, str] | None = None) -> list[Curve]:
    """Read curves in the order of their rates; `units` of columns that state none; `BadInput` for faults."""
    try:
        return _read(cells.read(Path(path)), units or {})
    except ValueError as error:
        raise BadInput(f"{path}: {error}") from error


def _read(table: cells.Cells, units: Mapping[str, str]) -> list[Curve]:
    parts = [_HEADER.fullmatch(name).groups() for name in table.names]
    table = table._replace(names=[name.lower() for name, _ in parts])
    header = dict(zip(table.names, (unit for _, unit in parts), strict=True))
    table.require("strain", "stress")
    columns = [name for name in UNITS if name in header]
    values = pd.DataFrame({name: _values(table, name, header[name], units) for name in columns})
    if len(values) < FEWEST_ROWS:
        raise ValueError(f"has {len(values)} rows, must have {FEWEST_ROWS} or more")
    if values.strain.max() == 0:
        raise ValueError("column strain: is 0 in every row")
    if values.stress.sum() <= 0:
        raise ValueError("column stress: is negative on the whole; compression must be positive")
    values = values.assign(rate=values.get("rate", 0.0))
    curves = []
    for test, rows in values.groupby(table.column("test") if "test" in header else "rate", sort=False):
        rate, strain = float(rows.rate.iloc[0]), rows.strain.to_numpy()
        if rows.rate.nunique() > 1:
            raise ValueError(f"test {test} has {rows.rate.nunique()} rates, must have one")
        if strain.size < FEWEST_OF_CURVE:
            fault = f"the rate {rate:g} 1/s has {strain.size} rows, must have {FEWEST_OF_CURVE} or more"
            raise ValueError(f"{fault}; all rows of a test must have one rate, the nominal one")
        if 0 < strain[0] == strain.max():
            fault = f"the curve at the rate {rate:g} 1/s begins at its largest strain"
            raise ValueError(f"{fault}; rows must be in the order of loading")
        curves.append(Curve(rate, strain, rows.stress.to_numpy()))
    return sorted(curves, key=lambda curve: curve.rate)


def _values(table: cells.Cells, column: str, stated: str | None, units: Mapping[str, str]) -> np.ndarray:
    """Values of a column in SI: strain and stress of compression, counted positive."""
    unit = stated or units.get(column) or _DEFAULT.get(column)
    factors = UNITS[column]
    if unit not in factors:
        problem, rule = f"unit = {unit}" if unit else "has no unit", " or ".join(factors)
        raise ValueError(f"column {column}: {problem}, must be {rule}: {column} ({[*factors][-1]})")
    values = factors[unit] * table.numbers(column)
    bound = _MOST[column]
    bad = (np.abs(values) > bound) | ((values < 0) & (column != "stress"))
    if bad.any():
        row = int(np.argmax(bad))
        line, cell = [*table.rows][row], table.column(column)[row]
        limits = f"from {-bound if column == 'stress' else 0:g} to {bound / factors[unit]:g} {unit}"
        convention = "compression is positive, and the unit stands behind the name"
        example = f"{column} ({[*factors][-1]})"
        raise ValueError(f"line {line}: {column} = {cell}, must be {limits}; {convention}: {example}")
    return values
