"""Plans that vary a config, or describe what is beside the study: YAML files of their own models."""

from pathlib import Path
from typing import Any

from bladerub.config import files
from bladerub.config.errors import ConfigError, Problem
from bladerub.config.files import Located
from bladerub.config.problems import problems
from bladerub.config.quantities import converted
from bladerub.config.read import location_of
from bladerub.settings.study import Config


def read_plan(path: str | Path, kind: Any, key: str | None = None, study: Config | None = None) -> Located:
    """Read and check a plan, which varies a config: the YAML file at `path`, of the model `kind`.

    `key` of the config names the file. Without the `study` a speed, E or K of the plan is a plain number.
    Raises `ConfigError` with every problem found.
    """
    plan, _ = converted(files.read(path, key), kind, study)
    of_study = study and study.plain()
    texts, locations = dict.fromkeys(problems(plan.plain(), kind, of_study)), plan.locations()
    if texts:
        raise ConfigError(Problem(location_of(text, locations, plan.location), text) for text in texts)
    return plan
