"""How the claims are judged with each set of choices that a plan lists."""

from collections.abc import Mapping
from pathlib import Path

import pandas as pd

from bladerub.extras.variations.job import VERDICTS
from bladerub.io import tables
from bladerub.study import findings
from bladerub.study.findings.claim import SCORE

COUNTS = ["set", "yes", "partly", "no", "better", "worse"]
"""Columns of ``calibration_counts.csv``."""


def collect(paths: Mapping[str, str | Path]) -> pd.DataFrame:
    """Put the verdicts of all sets, in a file by the name of each, into one table of `VERDICTS`."""
    verdicts = [tables.read(path, VERDICTS).assign(set=name) for name, path in paths.items()]
    return pd.concat(verdicts, ignore_index=True)


def counts(table: pd.DataFrame) -> pd.DataFrame:
    """Count the verdicts of each set in a `table` of `collect`, and name those that differ from the first.

    A row a set with `COUNTS`. A verdict that the one set has and the other does not is left out.
    """
    holds = findings.verdicts(table, by="set")
    score = holds.apply(lambda verdicts: verdicts.map(SCORE))
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
