"""The plan of an identification: what varies, what is simulated of each set, and how many sets there are."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from bladerub.config import read as configuration
from bladerub.config.errors import ConfigError, format_value
from bladerub.config.files import Located
from bladerub.extras.factors import Factor, lay_over, read_factors
from bladerub.extras.identification.settings import IdentificationPlan

BATCH = 4
"""Sets of one job."""
FEWEST = 16
"""Simulated sets below which a target has no emulator."""


@dataclass(frozen=True)
class Part:
    """A small study, and the claims that it is for."""

    claims: tuple[str, ...]  # ``C2`` or ``C12``
    study: Located  # what is laid over the study


@dataclass(frozen=True)
class Candidates:
    """The best sets of all waves, which are judged by all claims on a finer grid."""

    number: int
    neighbours: int  # of each
    shift: float  # of every factor of a neighbour, up or down, as a share of its range
    study: Located


@dataclass(frozen=True)
class Plan:
    """A plan as read; `seed` is that of everything drawn."""

    seed: int
    factors: tuple[Factor, ...]
    parts: dict[str, Part]
    sets: dict[
        str, dict[str, float]
    ]  # given sets of the first wave: values by factor, the study's for others
    waves: tuple[int, ...]  # sets drawn in each
    remaining: float  # share of the ranges that must be left, or a target is given up
    candidates: Candidates

    def size(self, wave: int) -> int:
        """Count the sets of a wave, from 1; the first has the study's own and the given ones as well."""
        return self.waves[wave - 1] + (1 + len(self.sets) if wave == 1 else 0)

    def first(self, wave: int) -> int:
        """Return the number of the first set of a wave; the sets of all waves are counted through."""
        return sum(self.size(earlier) for earlier in range(1, wave))

    def batches(self, wave: int) -> list[range]:
        """Return the sets of each job of a wave."""
        first, end = self.first(wave), self.first(wave) + self.size(wave)
        return [range(start, min(start + BATCH, end)) for start in range(first, end, BATCH)]

    def given(self, study: dict[str, Any]) -> np.ndarray:
        """Return the positions of the study's own values, then of the given sets, (1 + n_sets, d)."""
        reference = [factor.position(factor.own(study)) for factor in self.factors]
        rows = [reference]
        for values in self.sets.values():
            pairs = zip(self.factors, reference, strict=True)
            rows.append(
                [f.position(values[f.name]) if f.name in values else position for f, position in pairs]
            )
        return np.array(rows)


def read_plan(path: str | Path) -> Plan:
    """Read a plan (config/identification.yaml says what it holds).

    Raises `ConfigError` if it is none: the message has file, line, key, value and what would be right.
    """
    located = configuration.read_plan(path, IdentificationPlan)
    content = located.content
    factors = read_factors(content["factors"])
    parts = {
        name: Part(tuple(part.content["claims"].plain()), part.content["study"])
        for name, part in content["parts"].content.items()
    }
    candidates = content["candidates"].content
    numbers = {key: candidates[key].plain() for key in ("number", "neighbours", "shift")}
    plan = Plan(
        seed=content["seed"].content,
        factors=factors,
        parts=parts,
        sets={name: _given(name, entry, factors) for name, entry in content["sets"].content.items()},
        waves=tuple(content["waves"].plain()),
        remaining=content["remaining"].plain(),
        candidates=Candidates(**numbers, study=candidates["study"]),
    )
    if (missing := FEWEST - plan.size(1)) > 0:
        raise ConfigError.at(
            content["waves"].location,
            f"waves = {format_value(list(plan.waves))}: the first must be at least "
            f"{plan.waves[0] + missing}, or no target has an emulator after it",
        )
    return plan


def _given(name: str, entry: Located, factors: tuple[Factor, ...]) -> dict[str, float]:
    """Check that a given set has values of the factors, within their ranges."""
    by_name, values = {factor.name: factor for factor in factors}, entry.plain()
    for key, value in values.items():
        message = f"sets.{name}.{key} = {format_value(value)}: must be"
        if key not in by_name:
            raise ConfigError.at(entry.location, f"{message} of a factor: {', '.join(by_name)}")
        low, high = by_name[key].range
        if not low <= value <= high:
            raise ConfigError.at(
                entry.location, f"{message} from {low:g} to {high:g}, the range of the factor"
            )
    return values


def config_of(study: dict[str, Any], plan: Plan, variation: Located, positions: np.ndarray) -> dict[str, Any]:
    """Make and check the config of a set at `positions` (d,), with a part or the candidates' study laid over.

    Raises `ConfigError` if the values make no study together.
    """
    varied = lay_over(configuration.vary(study, variation), plan.factors, positions)
    return configuration.validate(varied, "a set of the identification")
