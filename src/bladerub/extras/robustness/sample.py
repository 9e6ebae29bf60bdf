"""The samples of one job: a small study with the values of each, and its findings."""

import time
from collections.abc import Collection, Iterable, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.config import read as configuration
from bladerub.extras.small_study import conduct

COLUMNS = ["sample", "id", "holds", "margin"]
"""Columns of the verdicts of a job."""

COST = ["part", "sample", "runs", "cpu_s"]
"""Columns of the cost of its samples: runs, and processor time in s without that of the blade."""


def judge(
    part: str,
    samples: Mapping[int, dict[str, Any]],
    claims: Collection[str],
    blades: Iterable[tuple[str | Path, str | Path]],
) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Make the study of each sample, and judge the `claims` of their `part`.

    `samples` are configs by the number of the sample, from `bladerub.extras.robustness.design.batch`;
    `blades` are the files of each sample's reduced blade and of the accuracy of that. Returns verdicts and
    cost, with `COLUMNS` and `COST`. Raises `ConfigError` if the values of a sample make no study together.
    """
    verdicts, cost = [], []
    for (number, config), (model, rom_accuracy) in zip(samples.items(), blades, strict=True):
        start = time.process_time()
        study = conduct(configuration.validate(config), model, rom_accuracy, claims=claims)
        verdicts.append(study.findings.assign(sample=number)[COLUMNS])
        cost.append((part, number, study.n_runs, time.process_time() - start))
    return pd.concat(verdicts, ignore_index=True), pd.DataFrame(cost, columns=COST)
