"""Numbers of another calculation, or another program, beside reference numbers with their uncertainty."""

from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.io import tables

READ = ["number", "value"]
"""Columns that a compared table must have; ``unit`` and ``uncertainty`` are looked at if they are there."""

COLUMNS = ["table", "number", "reference", "value", "allowed", "unit", "agrees"]
"""Columns of the comparison; ``allowed`` is the largest difference that is within the uncertainties."""

COVERAGE = 2.0
"""How many times their joint uncertainty two numbers may differ: 95 % of them, if the errors are normal."""

_DIGITS = 1e-6  # relative; tables have seven digits


def compare(folder: str | Path, reference: str | Path, coverage: float = COVERAGE) -> pd.DataFrame:
    """Compare the tables of `folder` with those of `reference` that have the same names.

    Two numbers agree where they differ by no more than `coverage` times the root of the sum of squares of
    their uncertainties. A compared number without one counts as exact. Raises ValueError if the folders have
    no table and number in common, or a number has another unit; OSError if a table cannot be read or lacks a
    column.
    """
    folder, parts = Path(folder), []
    for path in sorted(Path(reference).glob("*.csv")):
        reference_table = tables.read(path)
        if not {*READ, "uncertainty", "unit"} <= set(reference_table) or not (folder / path.name).is_file():
            continue
        table = tables.read(folder / path.name, READ)
        table = table[[column for column in (*READ, "unit", "uncertainty") if column in table]]
        both = reference_table.merge(table, on="number", suffixes=("_reference", ""))
        _check_units(folder / path.name, both)
        parts.append(_judged(both, coverage).assign(table=path.stem))
    if not parts or not sum(map(len, parts)):
        raise ValueError(f"{folder}: has no number in common with {reference}")
    return pd.concat(parts, ignore_index=True)[COLUMNS]


def _check_units(path: Path, both: pd.DataFrame) -> None:
    if "unit_reference" not in both:
        return
    other = both[both.unit.astype(str) != both.unit_reference.astype(str)]
    if len(other):
        first = other.iloc[0]
        raise ValueError(f"{path}: {first.number} is in {first.unit}; must be in {first.unit_reference}")


def _judged(both: pd.DataFrame, coverage: float) -> pd.DataFrame:
    if "uncertainty_reference" in both:
        joint = np.hypot(both.uncertainty_reference, both.uncertainty.fillna(0.0))
    else:
        joint = both.uncertainty
    allowed = coverage * joint + _DIGITS * both.value_reference.abs()
    return pd.DataFrame(
        {
            "number": both.number,
            "reference": both.value_reference,
            "value": both.value,
            "allowed": allowed,
            "unit": both.unit,
            "agrees": (both.value - both.value_reference).abs() <= allowed,
        }
    )
