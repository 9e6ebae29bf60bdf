"""What varies: the small studies of a plan, the factors that are drawn for them, and the jobs that it takes.

The plan of a calibration lists its sets of inputs in the words of a config. That of a robustness draws the
factors of all its samples at once; every part has as many samples as its runs allow, the first ones of one
sequence: sample 7 has the same factors in each. That of an identification draws them in waves.
"""

import itertools
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bladerub.config import files
from bladerub.config.errors import UNKNOWN, ConfigError, Location
from bladerub.config.files import Located
from bladerub.extras import plans
from bladerub.extras.variations import settings
from bladerub.extras.variations.factors import Factor, read_factors
from bladerub.io.errors import format_value
from bladerub.settings.study import Config

REFERENCE = -1
"""Number of the sample of a robustness that has the study's own values."""

FEWEST = 16
"""Simulated sets below which there are no emulators and no indices."""

_SAMPLES, _SETS = 8, 4  # of one job, in a robustness and in an identification


@dataclass(frozen=True)
class Part:
    """A small study, and the claims that it is for."""

    name: str
    study: tuple[Located, ...]  # laid over the study, one after the other
    claims: tuple[str, ...] | None = None  # ``C2`` or ``C12``; all without it
    samples: int = 0  # of a robustness: the first ones of the sequence
    location: Location = UNKNOWN  # in the plan


class Job(NamedTuple):
    """Sets of inputs that one process simulates, by name or number, with a small study for each part."""

    sets: Sequence[str | int]
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class Plan:
    """A plan as read: `parts` and, if they are drawn, `factors`."""

    parts: dict[str, Part]
    factors: tuple[Factor, ...] = ()
    seed: int = 0  # of everything drawn
    waves: tuple[int, ...] = ()  # sets drawn in each; the samples of a robustness are one
    # of an identification: sets of the first wave, values by factor, the study's for others
    sets: dict[str, dict[str, float]] = field(default_factory=dict)
    remaining: float = 0.0  # share of the ranges that must be left, or a target is given up
    candidates: settings.CandidateSettings | None = None
    finer: Part | None = None  # the study by which candidates are judged

    def size(self, wave: int) -> int:
        """Count the sets of a wave, from 1; the first has the study's own and the given ones as well."""
        return self.waves[wave - 1] + (1 + len(self.sets) if wave == 1 else 0)

    def first(self, wave: int) -> int:
        """Return the number of the first set of a wave; the sets of all waves are counted through."""
        return sum(self.size(earlier) for earlier in range(1, wave))

    def jobs(self) -> dict[str, Job]:
        """Return every job by its name, which is that of the folder of its tables as well."""
        parts = tuple(self.parts.values())
        if self.candidates:
            return {
                f"wave{wave}/{name}": Job(sets, parts)
                for wave in range(1, len(self.waves) + 1)
                for name, sets in _batches(self.first(wave), self.size(wave), _SETS).items()
            } | {
                f"candidates/{candidate}_{neighbour}": Job((number,), (self.finer,))
                for number, (candidate, neighbour) in enumerate(self.candidates.pairs)
            }
        if self.factors:
            return {
                f"{part.name}/{name}": Job(sets, (part,))
                for part in parts
                for name, sets in {"reference": (REFERENCE,), **_batches(0, part.samples, _SAMPLES)}.items()
            }
        return {part.name: Job((part.name,), (part,)) for part in parts}

    def listed(self, study: Config) -> np.ndarray:
        """Return the positions of the study's own values, then of the listed sets, (1 + n_sets, d).

        Raises `ConfigError` if one of the study's own is outside the range of its factor.
        """
        own = {factor.name: factor.own(study) for factor in self.factors}
        for factor in self.factors:
            low, high = factor.range
            if not low <= own[factor.name] <= high:
                key = f"factors.{factor.name}.sets.{next(iter(factor.ranges))} = {format_value([low, high])}"
                requirement = f"must hold the study's own value, {own[factor.name]:g}"
                raise ConfigError.at(factor.location, f"{key}: {requirement}")
        sets = [own, *(own | values for values in self.sets.values())]
        return np.array([[f.position(values[f.name]) for f in self.factors] for values in sets])

    @property
    def ranges(self) -> list[tuple]:
        """What of the factors determines their values."""
        return [(f.name, f.ranges, f.logarithmic, f.multiple_of) for f in self.factors]

    def sampling(self, study: Config) -> dict[str, Any]:
        """Return all but results of earlier waves that determines the sets of an identification."""
        return {"seed": self.seed, "factors": self.ranges, "listed": self.listed(study).tolist()}


def read(kind: str, path: str | Path, key: str | None = None) -> Plan:
    """Read the plan of a calibration, robustness or identification; those in config/ say what one holds.

    `key` of the config names the file, if any. Raises `ConfigError` if it is none: the message has file,
    line, key, value and what would be right.
    """
    model, reader = {
        "calibration": (settings.CalibrationPlan, partial(_calibration, Path(path).parent)),
        "robustness": (settings.RobustnessPlan, _robustness),
        "identification": (settings.IdentificationPlan, _identification),
    }[kind]
    return reader(plans.read_plan(path, model, key).content)


def _batches(first: int, count: int, size: int) -> dict[str, range]:
    """Cut `count` numbers from `first` on into jobs of a `size`, by the number of the job."""
    starts = range(first, first + count, size)
    return {str(job): range(start, min(start + size, first + count)) for job, start in enumerate(starts)}


def _part(name: str, located: Located) -> Part:
    entry = located.content
    samples = entry["samples"].content if "samples" in entry else 0
    return Part(name, (entry["study"],), tuple(entry["claims"].plain()), samples, located.location)


def _calibration(folder: Path, content: Mapping[str, Located]) -> Plan:
    overlays = [content["common"]] if "common" in content else []
    if named := content.get("file"):
        overlays.insert(0, files.read(folder / named.content, "file", named.location))
    sets = content["sets"].content
    return Plan({name: Part(name, (*overlays, choices)) for name, choices in sets.items()})


def _robustness(content: Mapping[str, Located]) -> Plan:
    factors = read_factors(content["factors"])
    parts = {name: _part(name, entry) for name, entry in content["parts"].content.items()}
    for one, other in itertools.combinations(parts.values(), 2):
        if both := set(one.claims) & set(other.claims):
            text = f"parts.{other.name}.claims: {min(both)} is judged by another part, must be by one alone"
            raise ConfigError.at(other.location, text)
    samples = max(part.samples for part in parts.values())
    return Plan(parts, factors, content["seed"].content, (samples,))


def _identification(content: Mapping[str, Located]) -> Plan:
    factors, chosen = read_factors(content["factors"]), content["candidates"].content
    plan = Plan(
        parts={name: _part(name, entry) for name, entry in content["parts"].content.items()},
        factors=factors,
        seed=content["seed"].content,
        waves=tuple(content["waves"].plain()),
        sets={name: _listed(name, entry, factors) for name, entry in content["sets"].content.items()},
        remaining=content["remaining"].plain(),
        candidates=settings.CandidateSettings(**content["candidates"].plain()),
        finer=Part("candidates", (chosen["study"],)),
    )
    if (missing := FEWEST - plan.size(1)) > 0:
        raise ConfigError.at(
            content["waves"].location,
            f"waves = {format_value(list(plan.waves))}: the first must be at least "
            f"{plan.waves[0] + missing}, or no target has an emulator after it",
        )
    if (number := plan.candidates.number) > (most := plan.first(len(plan.waves) + 1) - 1):
        text = f"candidates.number = {number}: must be at most {most}, the sets of all waves but the study's"
        raise ConfigError.at(chosen["number"].location, text)
    return plan


def _listed(name: str, entry: Located, factors: tuple[Factor, ...]) -> dict[str, float]:
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
