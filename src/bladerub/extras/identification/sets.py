"""Tables of the sets of values that the waves of an identification draw."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.extras.identification.plan import Plan
from bladerub.io.tables import read as read_table

POSITIONS = ["set", "factor", "range_fraction"]
"""Columns of the sets of a wave: each factor as a fraction of its range."""


def as_table(plan: Plan, first: int, drawn: np.ndarray) -> pd.DataFrame:
    """Make the table of the sets `drawn` (n, d), numbered from `first`, with `POSITIONS`."""
    names = [factor.name for factor in plan.factors]
    numbers = np.repeat(np.arange(first, first + len(drawn)), len(names))
    return pd.DataFrame({"set": numbers, "factor": names * len(drawn), "range_fraction": np.ravel(drawn)})


def positions(paths: Iterable[str | Path]) -> pd.DataFrame:
    """Read tables of `as_table`: a row for each set, a column for each factor, in their order."""
    long = pd.concat([read_table(path, POSITIONS) for path in paths])
    return long.pivot(index="set", columns="factor", values="range_fraction")[
        list(dict.fromkeys(long.factor))
    ]
