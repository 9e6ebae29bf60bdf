"""What varies: the small studies of a plan, the factors that are drawn for them, and the jobs that it takes.

The plan of a calibration lists its sets of inputs in the words of a config. That of a robustness draws the
factors of all its samples at once; every part has as many samples as its runs allow, the first ones of one
sequence: sample 7 has the same factors in each. That of an identification draws them in waves.
"""

import copy
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import reduce
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bladerub.config import files
from bladerub.config.errors import ConfigError, Location, Problem
from bladerub.config.files import Located
from bladerub.config.problems import is_number
from bladerub.config.read import location_of
from bladerub.extras import plans
from bladerub.extras.variations import settings
from bladerub.extras.variations.settings import Factor
from bladerub.io.errors import format_value
from bladerub.settings.study import Config

REFERENCE = -1
"""Number of the sample of a robustness that has the study's own values."""

_KINDS = {
    "calibration": settings.CalibrationPlan,
    "robustness": settings.RobustnessPlan,
    "identification": settings.IdentificationPlan,
}
_SAMPLES, _SETS = 8, 4  # of one job, in a robustness and in an identification


@dataclass(frozen=True)
class Part:
    """A small study, and the claims that it is for."""

    name: str
    study: tuple[Located, ...]  # laid over the study, one after the other
    claims: list[str] | None = None  # ``C2`` or ``C12``; all without it
    samples: int = 0  # of a robustness: the first ones of the sequence


class Job(NamedTuple):
    """Sets of inputs that one process simulates, by name or number, with a small study for each part."""

    sets: Sequence[str | int]
    parts: tuple[Part, ...]


@dataclass(frozen=True)
class Plan:
    """A plan as read: `parts` and, if they are drawn, `factors`."""

    parts: dict[str, Part]
    factors: dict[str, Factor] = field(default_factory=dict)
    seed: int = 0  # of everything drawn
    waves: Sequence[int] = ()  # sets drawn in each; the samples of a robustness are one
    # of an identification: sets of the first wave, values by factor, the study's for others
    sets: dict[str, dict[str, float]] = field(default_factory=dict)
    remaining: float = 0.0  # share of the ranges that must be left, or a target is given up
    candidates: settings.CandidateSettings | None = None
    finer: Part | None = None  # the study by which candidates are judged
    locations: Mapping[str, Location] = field(default_factory=dict)  # of all that it holds

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
        """Return the positions of the study's own values, then of the listed sets, (1 + n_sets, d)."""
        own = {}
        for name, factor in self.factors.items():
            low, high = factor.range
            try:
                own[name] = factor.own(study)
            except (IndexError, KeyError, TypeError, ValueError):
                raise self._no_number(name, next(iter(factor.sets))) from None
            if not low <= own[name] <= high:
                key = f"factors.{name}.sets.{next(iter(factor.sets))} = {format_value([low, high])}"
                text = f"{key}: must hold the study's own value, {own[name]:g}"
                raise ConfigError.at(location_of(text, self.locations), text)
        sets = [own, *(own | values for values in self.sets.values())]
        return np.array([[f.position(values[name]) for name, f in self.factors.items()] for values in sets])

    def sampling(self, study: Config) -> dict[str, Any]:
        """Return all but results of earlier waves that determines the sets of an identification."""
        return {"seed": self.seed, "factors": self.ranges, "listed": self.listed(study).tolist()}

    @property
    def ranges(self) -> list[tuple]:
        """What of the factors determines their values."""
        return [(name, f.sets, f.scale, f.multiple_of) for name, f in self.factors.items()]

    def lay_over(self, config: Located, positions: Iterable[float]) -> Located:
        """Set the numbers of all factors in a copy of `config`, by position; a switch is on from 0.5."""
        config = copy.deepcopy(config)
        for (name, factor), position in zip(self.factors.items(), positions, strict=True):
            for path, value in factor.values(float(position)).items():
                key = f"factors.{name}.sets.{path}"
                location, (*parents, last) = location_of(f"{key}:", self.locations), settings.keys_of(path)
                try:
                    group = reduce(lambda inner, part: inner.content[part], parents, config).content
                    present = group[last].plain()
                except (AttributeError, IndexError, KeyError, TypeError):
                    raise self._no_number(name, path) from None
                if isinstance(present, bool):
                    value = value >= 0.5
                elif not is_number(present):
                    raise ConfigError.at(location, f"{key} = {format_value(present)}: must be a number")
                group[last] = Located(value, location)
        return config

    def _no_number(self, name: str, path: str) -> ConfigError:
        text = f"factors.{name}.sets.{path}: must be a number of the study, it has none there"
        return ConfigError.at(location_of(text, self.locations), text)


def read(kind: str, path: str | Path, key: str | None = None) -> Plan:
    """Read the plan of a calibration, robustness or identification, named by `key` of the config, if any."""
    located = plans.read_plan(path, _KINDS[kind], key)
    plan, content = _KINDS[kind].model_validate(located.plain()), located.content
    if kind == "calibration":
        common = [content["common"]] if plan.common else []
        if plan.file:
            common.insert(0, files.read(Path(path).parent / plan.file, "file", content["file"].location))
        sets = content["sets"].content
        return Plan({name: Part(name, (*common, choices)) for name, choices in sets.items()})
    locations = located.locations()
    if problems := [Problem(location_of(text, locations), text) for text in plan.problems()]:
        raise ConfigError(problems)
    parts = {
        name: Part(name, (entry.content["study"],), **plan.parts[name].model_dump(exclude={"study"}))
        for name, entry in content["parts"].content.items()
    }
    drawn = dict(plan) | {"parts": parts, "locations": locations}
    if kind == "robustness":
        return Plan(**drawn, waves=[max(part.samples for part in parts.values())])
    return Plan(**drawn, finer=Part("candidates", (content["candidates"].content["study"],)))


def _batches(first: int, count: int, size: int) -> dict[str, range]:
    """Cut `count` numbers from `first` on into jobs of a `size`, by the number of the job."""
    starts = range(first, first + count, size)
    return {str(job): range(start, min(start + size, first + count)) for job, start in enumerate(starts)}
