"""How the claims are judged with each set of choices that a plan lists."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd

from bladerub.extras.variations.job import VERDICTS
from bladerub.io import tables
from bladerub.study.findings.claim import SCORE

COUNTS = ["set", "yes", "partly", "no", "better", "worse"]
"""Columns of ``calibration_counts.csv``."""


def collect(paths: Mapping[str, str | Path]) -> pd.DataFrame:
    """Put the verdicts of all sets, in a file by the name of each, into one table of `VERDICTS`."""
    of_sets = [tables.read(path, VERDICTS).assign(set=name) for name, path in paths.items()]
    return pd.concat(of_sets, ignore_index=True)


def counts(table: pd.DataFrame) -> pd.DataFrame:
    """Count the verdicts of each set in a `table` of `collect`, and name those that differ from the first.

    A row a set with `COUNTS`. A verdict that the one set has and the other does not is left out.
    """
    holds = verdicts(table, by="set")
    score = holds.apply(lambda of_set: of_set.map(SCORE))
    rows = []
    for name in holds:
        change = score[name] - score.iloc[:, 0]
        number = holds[name].value_counts()
        rows.append(
            {"set": name}
            | {word: number.get(word, 0) for word in SCORE}
            | {"better": " ".join(change[change > 0].index), "worse": " ".join(change[change < 0].index)}
        )
    return pd.DataFrame(rows, columns=COUNTS)


def verdicts(table: pd.DataFrame, by: str) -> pd.DataFrame:
    """Return ``holds`` of each claim (rows) by the values of the column `by` (columns), both in their order.

    `table` has the findings of several studies, or of several ways to judge one, which `by` distinguishes.
    """
    wide = table.pivot_table(index="id", columns=by, values="holds", aggfunc="first")
    return wide.loc[list(dict.fromkeys(table["id"])), list(dict.fromkeys(table[by]))]
