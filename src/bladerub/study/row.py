"""Rows of blades that rub on one coating, in place of the single blade (``ROWS`` of `bladerub.plugins`)."""

from collections.abc import Mapping
from typing import Any

from bladerub import plugins

KEY = "rotor"
"""Block of the config that describes the row."""


def rows() -> Any:
    """Return the module that computes rows; raises `ValueError` where the package is without it.

    It has `described(config)`, `stored(run)`, `determinants(row)` and `compute(row, blade, case, spec, key,
    analysis, keep_history, progress)`. A row has ``blades``.
    """
    if KEY not in (offered := plugins.offered("ROWS")):
        raise ValueError("row: this package computes no rows of blades; must be left out")
    return plugins.load(offered[KEY])


def row_of(config: Mapping[str, Any]) -> Any:
    """Describe the row of blades that the runs of the study are of; None for single blades.

    Raises `ValueError` if a list has neither one value nor one for each blade, and as `rows`.
    """
    return rows().described(config) if KEY in config else None
