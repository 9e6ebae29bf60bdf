"""The plan of a design: factors that vary together, and parts, small studies for some of the claims.

Each part has as many samples as its runs allow. All draw from one Sobol sequence: sample 7 has the same
factors in each.
"""

import itertools
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import qmc

from bladerub.config import read as configuration
from bladerub.config.errors import UNKNOWN, ConfigError, Location, format_value
from bladerub.config.files import Located

BATCH = 8
"""Samples of one job."""

REFERENCE, REFERENCE_BATCH = -1, "reference"
"""Number of the sample that has the study's own values, and name of its job."""


@dataclass(frozen=True)
class Factor:
    """One choice that the paper leaves open."""

    name: str
    unit: str
    ranges: dict[str, tuple[float, float]]  # lowest and highest of each number of the config that it sets
    logarithmic: bool = False  # whether the values are spread evenly on a logarithmic scale
    multiple_of: float | None = None  # values are rounded to a multiple of it
    location: Location = UNKNOWN  # in the plan

    def values(self, position: float) -> dict[str, float]:
        """Return each number that the factor sets, at a `position` from 0 to 1 of its range."""
        return {path: self._between(*ends, position) for path, ends in self.ranges.items()}

    def _between(self, low: float, high: float, position: float) -> float:
        if self.logarithmic:
            value = math.exp(math.log(low) + position * math.log(high / low))
        else:
            value = low + position * (high - low)
        if self.multiple_of is None:
            return value
        rounded = round(round(value / self.multiple_of) * self.multiple_of, 9)
        return int(rounded) if float(self.multiple_of).is_integer() else rounded


@dataclass(frozen=True)
class Part:
    """A small study for some of the claims."""

    name: str
    claims: tuple[str, ...]  # ``C2`` or ``C12``
    samples: int  # their number, the first ones of the sequence
    study: Located  # what is laid over the study
    location: Location = UNKNOWN  # in the plan

    def batches(self) -> list[range]:
        """Return the samples of each job but that of the reference."""
        return [range(first, min(first + BATCH, self.samples)) for first in range(0, self.samples, BATCH)]


@dataclass(frozen=True)
class Plan:
    """A plan as read; `seed` is that of the scrambling of the sequence."""

    seed: int
    factors: tuple[Factor, ...]
    parts: dict[str, Part]

    def positions(self) -> np.ndarray:
        """Return the samples (n, d) of the d factors, each from 0 to 1; n is that of the largest part."""
        sequence = qmc.Sobol(len(self.factors), scramble=True, rng=np.random.default_rng(self.seed))
        return sequence.random(max(part.samples for part in self.parts.values()))


def read_plan(path: str | Path) -> Plan:
    """Read a plan (config/robustness.yaml says what it holds).

    Raises `ConfigError` if it is none: the message has file, line, key, value and what would be right.
    """
    plan = configuration.read_plan(path, "robustness_plan")
    factors = tuple(_factor(name, entry) for name, entry in plan.content["factors"].content.items())
    parts = {name: _part(name, entry) for name, entry in plan.content["parts"].content.items()}
    for one, other in itertools.combinations(factors, 2):
        if both := one.ranges.keys() & other.ranges.keys():
            text = f"factors.{other.name}.sets.{min(both)}: is set by another factor, must be by one alone"
            raise ConfigError.at(other.location, text)
    for one, other in itertools.combinations(parts.values(), 2):
        if both := set(one.claims) & set(other.claims):
            text = f"parts.{other.name}.claims: {min(both)} is judged by another part, must be by one alone"
            raise ConfigError.at(other.location, text)
    return Plan(plan.content["seed"].content, factors, parts)


def _factor(name: str, located: Located) -> Factor:
    entry, location = located.plain(), located.location
    logarithmic, step = entry.get("scale") == "log", entry.get("multiple_of")
    for key, ends in entry["sets"].items():
        where = f"factors.{name}.sets.{key} = {format_value(ends)}: must be"
        if logarithmic and ends[0] <= 0:
            raise ConfigError.at(location, f"{where} above 0 on a logarithmic scale")
        if step and any(abs(end / step - round(end / step)) > 1e-6 for end in ends):
            raise ConfigError.at(location, f"{where} multiples of {step:g}, as the values between them are")
    ranges = {key: (float(low), float(high)) for key, (low, high) in entry["sets"].items()}
    return Factor(name, entry["unit"], ranges, logarithmic, step, location)


def _part(name: str, located: Located) -> Part:
    entry, location = located.plain(), located.location
    return Part(name, tuple(entry["claims"]), entry["samples"], located.content["study"], location)
