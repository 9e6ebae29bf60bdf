"""The config of each sample of a design, and the blade that it needs."""

from __future__ import annotations

import copy
import hashlib
import json
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from bladerub import config as configuration
from bladerub.config_faults import UNKNOWN, ConfigError, Fault, shown
from bladerub.config_files import Marked, extended, lay_over, mark, plain
from bladerub.study.robustness.plan import Part, Plan


def check(study: Mapping[str, Any], plan: Plan) -> None:
    """Check that the factors' ends, all low and all high, give a study in each part.

    Each sample is checked again before its work; this is what can be told before any.

    Raises
    ------
    ConfigError
        As `sample_config`.
    """
    for part in plan.parts.values():
        for at in (0.0, 1.0):
            configuration.checked(_varied(study, plan, part, np.full(len(plan.factors), at)))


def sample_configs(study: Mapping[str, Any], plan: Plan, part: Part) -> list[dict[str, Any]]:
    """Make the config of every sample of a part, in their order; see `check` for how far they are checked.

    Raises
    ------
    ConfigError
        If a factor sets what the study does not have.
    """
    return [plain(_varied(study, plan, part, places)) for places in plan.places()[: part.samples]]


def blade_name(config: Mapping[str, Any]) -> str:
    """Name the blade of a sample; samples with the same blade have the same."""
    described = json.dumps([config["blade"], config["reduction"]], sort_keys=True)
    return hashlib.sha256(described.encode()).hexdigest()[:12]


def _varied(study: Mapping[str, Any], plan: Plan, part: Part, places: np.ndarray) -> Marked:
    varied = lay_over(mark(study, UNKNOWN), extended(part.study))
    for factor, at in zip(plan.factors, places, strict=True):
        for path, value in factor.values(float(at)).items():
            said = f"factors.{factor.name}.sets.{path}"
            varied = _replaced(varied, _keys(path), Marked(value, factor.place), said)
    return varied


def _keys(path: str) -> list[str | int]:
    """Take a path such as ``casings.2nd5nd.weights[0]`` apart."""
    return [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]


def _replaced(config: Marked, keys: list[str | int], value: Marked, said: str) -> Marked:
    """Set the number that `keys` lead to, in a copy."""
    content = config.content
    if not keys:
        if isinstance(content, bool) or not isinstance(content, int | float):
            raise ConfigError([Fault(value.place, f"{said} = {shown(plain(config))}: must be a number")])
        return value
    known = content if isinstance(content, dict) else range(len(content)) if isinstance(content, list) else ()
    if keys[0] not in known:
        raise ConfigError([Fault(value.place, f"{said}: must be a number of the study, it has none there")])
    changed = copy.copy(content)
    changed[keys[0]] = _replaced(content[keys[0]], keys[1:], value, said)
    return Marked(changed, config.place)
