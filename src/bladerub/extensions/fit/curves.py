"""Compressive stress-strain curves from a table: columns `strain`, `stress`, `rate`, perhaps `test`.

A unit stands behind the name of its column, in brackets: ``stress (MPa)``. What follows a ``#`` is a comment.
The rows of a rate, or of a test where that column is there, are one curve, in the order of loading.
"""

import re
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bladerub.io.errors import BadInput

UNITS = {
    "strain": {"1": 1.0, "%": 0.01},
    "stress": {"Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9},
    "rate": {"1/s": 1.0},
}
"""Units of each column, in SI."""
_DEFAULT = {"strain": "1", "rate": "1/s"}  # stress has none: Pa and MPa are both usual
FEWEST_ROWS = 5
_HEADER = re.compile(r"\s*(.*?)\s*(?:[\[(]\s*([^\])]*?)\s*[\])])?\s*", re.DOTALL)


class Curve(NamedTuple):
    """A test at one rate."""

    rate: float  # Of strain, 1/s; 0 where the table has no rate
    strain: np.ndarray  # (n,): Compressive, in the order of loading
    stress: np.ndarray  # (n,): Compressive, Pa


def read(path: str | Path, units: Mapping[str, str] | None = None) -> list[Curve]:
    """Read the curves of a table, in the order of their rates.

    `units` states the units of columns whose header has none. Raises `BadInput` that names column, row and
    value of what cannot be used.
    """
    path = Path(path)
    table = _table(path)
    names = [_HEADER.fullmatch(name).groups() for name in table.columns]
    header = {name.lower(): unit for name, unit in names}
    table.columns = pd.Index([name.lower() for name, _ in names])
    if table.columns.has_duplicates:
        raise BadInput(f"{path}: has the column {table.columns[table.columns.duplicated()][0]} twice")
    for column in ("strain", "stress"):
        if column not in header:
            raise BadInput(
                f"{path}: has no column {column}; must have strain, stress and, for several rates, rate"
            )
    if len(table) < FEWEST_ROWS:
        raise BadInput(f"{path}: has {len(table)} rows, must have {FEWEST_ROWS} or more")
    values = pd.DataFrame(
        {
            column: _numbers(path, table[column], column) * _unit(path, column, header[column], units or {})
            for column in UNITS
            if column in header
        }
    )
    values = values.assign(rate=values.get("rate", 0.0))
    _check(path, values, table)
    if "test" in table.columns:
        groups = values.groupby(table["test"].to_numpy(), sort=False)
        for name, rows in groups:
            if rows.rate.nunique() > 1:
                raise BadInput(f"{path}: test {name} has {rows.rate.nunique()} rates, must have one")
    else:
        groups = values.groupby("rate")
    curves = [
        Curve(float(rows.rate.iloc[0]), rows.strain.to_numpy(), rows.stress.to_numpy()) for _, rows in groups
    ]
    return sorted(curves, key=lambda curve: curve.rate)


def _table(path: Path) -> pd.DataFrame:
    if not path.is_file():
        raise BadInput(f"{path}: there is no such file")
    try:
        cells = pd.read_csv(
            path, dtype=str, comment="#", keep_default_na=False, skipinitialspace=True, header=None
        )
    except (UnicodeDecodeError, pd.errors.ParserError, pd.errors.EmptyDataError) as error:
        raise BadInput(f"{path}: is not a table in CSV ({str(error).strip()})") from error
    # read as a row like the others: pandas would rename a column that is there twice
    return cells.iloc[1:].set_axis(cells.iloc[0], axis=1).reset_index(drop=True)


def _unit(path: Path, column: str, stated: str | None, units: Mapping[str, str]) -> float:
    """Factor from the unit of a column, of its header before that of `units`, to SI."""
    unit = stated or units.get(column) or _DEFAULT.get(column)
    known = UNITS[column]
    if unit not in known:
        problem = f"unit = {unit}" if unit else "has no unit"
        raise BadInput(
            f"{path}: column {column}: {problem}, must be {' or '.join(known)}: {column} ({[*known][-1]})"
        )
    return known[unit]


def _numbers(path: Path, cells: pd.Series, column: str) -> pd.Series:
    numbers = pd.to_numeric(cells, errors="coerce").astype(float)
    bad = ~np.isfinite(numbers.to_numpy())
    if bad.any():
        row = int(np.argmax(bad))
        raise BadInput(
            f"{path}: row {row + 1}: {column} = {cells.iloc[row] or 'nothing'}, must be a finite number"
        )
    return numbers


def _check(path: Path, values: pd.DataFrame, table: pd.DataFrame) -> None:
    """Check that strain and stress are those of compression, counted positive, and that rates are rates."""
    for column in ("strain", "rate"):
        bad = values[column].to_numpy() < 0
        if bad.any():
            row = int(np.argmax(bad))
            raise BadInput(
                f"{path}: row {row + 1}: {column} = {table[column].iloc[row]}, must be 0 or more; "
                "compression is positive"
            )
    if values.strain.max() == 0:
        raise BadInput(f"{path}: column strain: is 0 in every row")
    if values.stress.sum() <= 0:
        raise BadInput(f"{path}: column stress: is negative on the whole; compression must be positive")
