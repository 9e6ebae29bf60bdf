"""The plan of a design: factors that vary together, and parts, small studies for some of the claims.

Each part has as many samples as its runs allow. All draw from one Sobol sequence: sample 7 has the same
factors in each.
"""

import itertools
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.stats import qmc

from bladerub.config import read as configuration
from bladerub.config.errors import UNKNOWN, ConfigError, Location
from bladerub.config.files import Located
from bladerub.extras.factors import Factor, read_factors
from bladerub.extras.robustness.settings import RobustnessPlan

BATCH = 8
"""Samples of one job."""

REFERENCE, REFERENCE_BATCH = -1, "reference"
"""Number of the sample that has the study's own values, and name of its job."""


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
    plan = configuration.read_plan(path, RobustnessPlan)
    factors = read_factors(plan.content["factors"])
    parts = {name: _part(name, entry) for name, entry in plan.content["parts"].content.items()}
    for one, other in itertools.combinations(parts.values(), 2):
        if both := set(one.claims) & set(other.claims):
            text = f"parts.{other.name}.claims: {min(both)} is judged by another part, must be by one alone"
            raise ConfigError.at(other.location, text)
    return Plan(plan.content["seed"].content, factors, parts)


def _part(name: str, located: Located) -> Part:
    entry, location = located.plain(), located.location
    return Part(name, tuple(entry["claims"]), entry["samples"], located.content["study"], location)
