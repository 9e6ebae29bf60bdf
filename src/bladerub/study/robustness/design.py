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
from bladerub.study.grid import coating_cases
from bladerub.study.robustness.plan import REFERENCE, REFERENCE_BATCH, Part, Plan

_DETERMINING = ("blade", "reduction", "contact", "coatings", "speeds", "solver", "analysis")  # and casings


def check(study: Mapping[str, Any], plan: Plan) -> None:
    """Check every sample of every part.

    Raises
    ------
    ConfigError
        If a factor sets what the study does not have, or the values of a sample make no study together; names
        part and sample.
    """
    for part in plan.parts.values():
        for number, places in enumerate(plan.places()[: part.samples]):
            varied = _varied(study, plan, part, places)
            try:
                configuration.checked(varied)
            except ConfigError as error:
                faults = [
                    Fault(place, f"parts.{part.name}, sample {number}: {text}")
                    for place, text in error.faults
                ]
                raise ConfigError(faults) from error


def sample_configs(study: Mapping[str, Any], plan: Plan, part: Part) -> list[dict[str, Any]]:
    """Make the config of every sample of a part, in their order, unchecked.

    Raises
    ------
    ConfigError
        If a factor sets what the study does not have.
    """
    return [plain(_varied(study, plan, part, places)) for places in plan.places()[: part.samples]]


def reference_config(study: Mapping[str, Any], part: Part) -> dict[str, Any]:
    """Make the config of a part with the study's own values in place of a sample's."""
    return plain(lay_over(mark(study, UNKNOWN), extended(part.study)))


def batch(study: Mapping[str, Any], plan: Plan, part: Part, name: str) -> dict[int, dict[str, Any]]:
    """Make the config of each sample of one job by its number.

    Parameters
    ----------
    name : str
        Number of the job, one of `bladerub.study.robustness.plan.Part.batches`, or `REFERENCE_BATCH`.
    """
    if name == REFERENCE_BATCH:
        return {REFERENCE: reference_config(study, part)}
    samples = sample_configs(study, plan, part)
    return {number: samples[number] for number in part.batches()[int(name)]}


def sample_digest(config: Mapping[str, Any]) -> str:
    """Digest what of its config determines what a sample says."""
    used = {case.casing for case in coating_cases(config)}
    determining = {key: config[key] for key in _DETERMINING}
    determining["casings"] = {name: config["casings"][name] for name in sorted(used)}
    return _digest(determining)


def blade_name(config: Mapping[str, Any]) -> str:
    """Name the blade of a sample; samples with the same blade have the same."""
    return _digest([config["blade"], config["reduction"]])[:12]


def _digest(content: Any) -> str:
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


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
