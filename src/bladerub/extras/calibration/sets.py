"""What the paper leaves open, varied: how its claims are judged with each set of choices.

A plan names sets of choices, each a part of a config that is laid over the study. Every set is a small study
of its own, from the blade to the findings.
"""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.blade.files import accuracy_path, mesh_path
from bladerub.config import files
from bladerub.config import read as configuration
from bladerub.config.errors import ConfigError
from bladerub.extras.calibration.settings import CalibrationPlan
from bladerub.extras.small_study import conduct
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.study import findings
from bladerub.study.findings.claim import SCORE

COLUMNS = ["set", "id", "claim", "paper", "measured", "unit", "holds", "margin"]
"""Columns of ``calibration.csv``."""

COUNTS = ["set", "yes", "partly", "no", "better", "worse"]
"""Columns of ``calibration_counts.csv``."""


def plan(config: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Read the plan of a study and make the config of each of its sets, by name and in the order of the plan.

    ``calibration`` of the study `config` names a YAML file (`CalibrationPlan`). Raises `ConfigError` if it is
    no plan or a set no config, with every problem and the set it is in.
    """
    return sets(config, config["calibration"], "calibration")


def sets(config: Mapping[str, Any], path: str | Path, key: str | None = None) -> dict[str, dict[str, Any]]:
    """Make the config of each set of the plan at `path`, as `plan`; `key` of the config names it, if any."""
    content, common = configuration.read_plan(path, CalibrationPlan, key).content, []
    if named := content.get("file"):
        common.append(files.read(Path(path).parent / named.content, "file", named.location))
    if "common" in content:
        common.append(content["common"])
    configs, problems = {}, []
    for name, choices in content["sets"].content.items():
        try:
            varied = configuration.vary(config, *common, choices)
            configs[name] = configuration.validate(varied, name)
        except ConfigError as error:
            problems += error.problems
    if problems:
        raise ConfigError(problems)
    return configs


def judge(config: Mapping[str, Any], folder: str | Path, report: Callable[[object], None]) -> pd.DataFrame:
    """Make the study of one set, with its config from `plan`, and return its findings.

    `folder` is for its blade, runs, maps and tables; runs that are there and current are kept. `report` is
    called with a `bladerub.study.job.RunDone` after each run.
    """
    folder, origin = Path(folder), provenance(config)
    model, table_folder = folder / "blade" / "reduced_model.h5", folder / "tables"
    write(build(config), origin, model, mesh_path(model), accuracy_path(model))
    study = conduct(config, model, accuracy_path(model), folder, report=report)
    tables.write(table_folder / "peaks.csv", study.peaks, origin)
    tables.write(table_folder / "divergence.csv", study.divergence, origin)
    return study.findings


def collect(paths: Mapping[str, str | Path]) -> pd.DataFrame:
    """Put the findings of all sets, in a file by the name of each, into one table of `COLUMNS`."""
    set_findings = [tables.read(path, findings.COLUMNS).assign(set=name) for name, path in paths.items()]
    return pd.concat(set_findings, ignore_index=True)[COLUMNS]


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
