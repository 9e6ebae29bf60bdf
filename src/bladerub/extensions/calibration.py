"""What the paper leaves open, varied: how its claims answer to each set of choices.

A plan names sets of choices, each a part of a config that is laid over the study. Every set is a small study
of its own, from the blade to the findings, by the same functions as the study itself.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.config import read as configuration
from bladerub.config.errors import UNKNOWN, ConfigError, Location, Problem
from bladerub.config.files import Located, resolve_extend
from bladerub.config.files import read as read_file
from bladerub.extensions.small_study import make_maps
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.study import divergence, findings, peaks

COLUMNS = ["set", "id", "claim", "paper", "measured", "unit", "holds", "margin"]


def plan(config: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Read the plan of a study and make the config of each of its sets.

    Parameters
    ----------
    config : mapping
        The study that the sets vary. Its ``calibration`` names a YAML file with ``common``, laid over the
        study in every set, and ``sets``, by name what is laid over that. Each of them can extend other files.

    Returns
    -------
    dict of str to dict
        The configs by the name of their sets, in the order of the plan.

    Raises
    ------
    ConfigError
        If the file is no plan or a set no config; every problem with the set it is in.
    """
    path = config["calibration"]
    content = read_file(path, "calibration").content
    sets = content.get("sets")
    if content.keys() - {"common", "sets"} or sets is None or not isinstance(sets.content, dict):
        raise ConfigError.at(Location(path), "must hold common and sets, and nothing else")
    study, configs, problems = Located.of(config, UNKNOWN), {}, []
    for name, choices in sets.content.items():
        if not name.replace("_", "").replace(".", "").isalnum():
            text = f"{name}: the name of a set must be of letters, digits, dots and underscores"
            problems.append(Problem(choices.location, text))
            continue
        varied = study
        for layer in (content.get("common"), choices):
            if layer is not None and layer.content is not None:
                varied = varied.merged(resolve_extend(layer))
        try:
            configs[name] = configuration.validate(varied)
        except ConfigError as error:
            problems += [Problem(place, f"{name}: {text}") for place, text in error.problems]
    if problems:
        raise ConfigError(problems)
    return configs


def answer(config: Mapping[str, Any], folder: str | Path, report: Callable[[object], None]) -> pd.DataFrame:
    """Make the study of one set, and put the claims to it.

    Parameters
    ----------
    config : mapping
        From `plan`.
    folder : path-like
        For its blade, runs, maps and tables; runs that are there and current are kept.
    report : callable
        Called with a `bladerub.study.job.RunDone` after each run.

    Returns
    -------
    DataFrame
        As `bladerub.study.findings.table`.
    """
    folder = Path(folder)
    model, accuracy = folder / "blade" / "reduced_model.h5", folder / "tables" / "rom_accuracy.csv"
    campbell = accuracy.with_name("campbell.csv")
    write(build(config), provenance(config), model, model.with_name("mesh.h5"), campbell, accuracy)
    maps = make_maps(config, model, folder, report)
    made = {"peaks": peaks.table(config, maps), "divergence": divergence.table(config, maps)}
    for name, table in made.items():
        tables.write(folder / "tables" / f"{name}.csv", table, provenance(config))
    return findings.table(config, maps, *(folder / "tables" / f"{name}.csv" for name in made), accuracy)


def gather(answers: Mapping[str, str | Path]) -> pd.DataFrame:
    """Put the findings of all sets into one table of `COLUMNS`.

    Parameters
    ----------
    answers : mapping of str to path-like
        File of findings by the name of the set.
    """
    answered = [tables.read(path, findings.COLUMNS).assign(set=name) for name, path in answers.items()]
    return pd.concat(answered, ignore_index=True)[COLUMNS]
