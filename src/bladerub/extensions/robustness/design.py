"""The config of each sample of a design, and the blade that it needs."""

from __future__ import annotations

import copy
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from bladerub.config import read as configuration
from bladerub.config.errors import UNKNOWN, ConfigError, Problem, format_value
from bladerub.config.files import Located, resolve_extend
from bladerub.config.schema import is_number
from bladerub.extensions.robustness.plan import REFERENCE, REFERENCE_BATCH, Part, Plan
from bladerub.io.provenance import config_digest
from bladerub.study.grid import coating_cases

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
            try:
                configuration.validate(_varied(study, plan, part, places))
            except ConfigError as error:
                problems = [
                    Problem(place, f"parts.{part.name}, sample {number}: {text}")
                    for place, text in error.problems
                ]
                raise ConfigError(problems) from error


def batch(study: Mapping[str, Any], plan: Plan, part: Part, name: str) -> dict[int, dict[str, Any]]:
    """Make the config of each sample of one job by its number, unchecked.

    Parameters
    ----------
    name : str
        Number of the job, one of `bladerub.extensions.robustness.plan.Part.batches`, or `REFERENCE_BATCH`,
        whose only sample has the study's own values.

    Raises
    ------
    ConfigError
        If a factor sets what the study does not have.
    """
    if name == REFERENCE_BATCH:
        return {REFERENCE: _laid_over(study, part).plain()}
    places = plan.places()
    return {
        number: _varied(study, plan, part, places[number]).plain() for number in part.batches()[int(name)]
    }


def sample_digest(config: Mapping[str, Any]) -> str:
    """Digest what of its config determines what a sample says."""
    used = {case.casing for case in coating_cases(config)}
    determining = {key: config[key] for key in _DETERMINING}
    determining["casings"] = {name: config["casings"][name] for name in sorted(used)}
    return config_digest(determining)


def blade_name(config: Mapping[str, Any]) -> str:
    """Name the blade of a sample; samples with the same blade have the same."""
    return config_digest({key: config[key] for key in ("blade", "reduction")})[:12]


def _laid_over(study: Mapping[str, Any], part: Part) -> Located:
    return Located.of(study, UNKNOWN).merged(resolve_extend(part.study))


def _varied(study: Mapping[str, Any], plan: Plan, part: Part, places: np.ndarray) -> Located:
    varied = _laid_over(study, part)
    for factor, at in zip(plan.factors, places, strict=True):
        for path, value in factor.values(float(at)).items():
            said = f"factors.{factor.name}.sets.{path}"
            varied = _replaced(varied, _keys(path), Located(value, factor.location), said)
    return varied


def _keys(path: str) -> list[str | int]:
    """Take a path such as ``casings.2nd5nd.weights[0]`` apart."""
    return [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]


def _replaced(config: Located, keys: list[str | int], value: Located, said: str) -> Located:
    """Set the number that `keys` lead to, in a copy."""
    content = config.content
    if not keys:
        if not is_number(content):
            raise ConfigError.at(value.location, f"{said} = {format_value(config.plain())}: must be a number")
        return value
    known = content if isinstance(content, dict) else range(len(content)) if isinstance(content, list) else ()
    if keys[0] not in known:
        raise ConfigError.at(value.location, f"{said}: must be a number of the study, it has none there")
    changed = copy.copy(content)
    changed[keys[0]] = _replaced(content[keys[0]], keys[1:], value, said)
    return Located(changed, config.location)
