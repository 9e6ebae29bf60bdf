"""What a config says of a calibration, and what the plans of variations hold."""

import itertools
import math
import re
from collections.abc import Iterator
from functools import reduce
from operator import getitem
from typing import Annotated, Any, Literal

from pydantic import Field

from bladerub.io.errors import format_value
from bladerub.settings.fields import ASCENDING, UNIQUE, Form, Name, Number, Omitted, Section, Seed

FEWEST = 16
"""Simulated sets below which there are no emulators and no indices."""

ConfigFile = Annotated[str, Field(pattern=r"^.+\.ya?ml$"), Form("the path of a .yaml file")]

CALIBRATION = Annotated[
    ConfigFile,
    Field(
        default="config/calibration.yaml",
        description="Plan of sets of choices, each a small study of its own, made by `snakemake -j2 "
        "calibration`. A relative path is relative to the folder that Snakemake runs in.",
    ),
]

Variation = Annotated[
    dict[str, Any] | None,
    Form("a group of keys, as of a config"),
    Field(description="What is laid over the study; it is checked as a part of the whole."),
]
Value = Annotated[Number, Field(ge=-1e12, le=1e12)]
Range = Annotated[list[Value], ASCENDING, Field(min_length=2, max_length=2)]
Claim = Annotated[str, Field(pattern=r"^C([1-9]|1[0-2])$"), Form("a claim of the paper, C1 to C12")]
SetName = Annotated[
    str,
    Field(pattern=r"^[_.]*[A-Za-z0-9][A-Za-z0-9_.]*$", max_length=80),
    Form("of at most 80 letters, digits, dots and underscores"),
]


class CalibrationPlan(Section):
    """Variations of the study, each a small study (studies/variations)."""

    file: Omitted[ConfigFile] = None
    """Laid over the study in every set; as seen from the plan."""
    common: Omitted[Variation] = None
    """Laid over that in every set."""
    sets: dict[SetName, Variation] = Field(min_length=1, max_length=1000)
    """What is laid over that, by name, which is that of the folder of the set."""


class Factor(Section):
    """One choice that the paper leaves open, which sets one or more numbers of the config."""

    unit: str = Field(min_length=1, max_length=40)
    """Of the values, as in the table of the samples."""
    scale: Omitted[Literal["linear", "log"]] = None
    """On which the samples are spread evenly; linear unless it says otherwise."""
    multiple_of: Omitted[Number] = Field(None, gt=0, le=1e12)
    """Values are rounded to a multiple of it."""
    sets: dict[str, Range] = Field(min_length=1, max_length=100)
    """Path of each number in the config, such as casings.2nd.weights[0], with its lowest and highest
    value."""

    @property
    def range(self) -> list[float]:
        """Lowest and highest value of the first number that it sets, which stands for all."""
        return next(iter(self.sets.values()))

    def own(self, config: Section) -> float:
        """Return the value that a config has of the first number."""
        return float(reduce(getitem, keys_of(next(iter(self.sets))), config.plain()))

    def position(self, value: float) -> float:
        """Return the position of a value of the first number; one outside the range lies at its end."""
        low, high = self.range
        value = min(max(value, low), high)
        if self.scale == "log":
            return math.log(value / low) / math.log(high / low)
        return (value - low) / (high - low)

    def first_value(self, position: float) -> float:
        """Return the first number that the factor sets, at a `position` from 0 to 1 of its range."""
        return next(iter(self.values(position).values()))

    def values(self, position: float) -> dict[str, float]:
        """Return each number that the factor sets, at a `position` from 0 to 1 of its range."""
        return {path: self._between(*ends, position) for path, ends in self.sets.items()}

    def _between(self, low: float, high: float, position: float) -> float:
        if self.scale == "log":
            value = math.exp(math.log(low) + position * math.log(high / low))
        else:
            value = low + position * (high - low)
        if self.multiple_of is None:
            return value
        rounded = round(round(value / self.multiple_of) * self.multiple_of, 9)
        return int(rounded) if float(self.multiple_of).is_integer() else rounded

    def problems(self) -> Iterator[str]:
        """Yield which of its numbers have a range that does not suit the scale or the multiples."""
        for path, ends in self.sets.items():
            if not keys_of(path):
                yield f"sets.{path}: must be the path of a number of the config"
            message = f"sets.{path} = [{ends[0]:g}, {ends[1]:g}]: must be"
            if self.scale == "log" and ends[0] <= 0:
                yield f"{message} above 0 on a logarithmic scale"
            step = self.multiple_of
            if step and any(abs(end / step - round(end / step)) > 1e-6 for end in ends):
                yield f"{message} multiples of {step:g}, as the values between them are"


def keys_of(path: str) -> list[str | int]:
    """Split a path such as ``casings.2nd5nd.weights[0]``."""
    return [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]


class DrawnPlan(Section):
    """Factors, whose values are drawn."""

    seed: Seed
    """Of everything that is drawn."""
    factors: dict[Name, Factor] = Field(min_length=1, max_length=100)
    """Choices that the paper leaves open, by name."""

    def problems(self) -> Iterator[str]:
        """Yield what the models cannot say."""
        for name, factor in self.factors.items():
            yield from (f"factors.{name}.{problem}" for problem in factor.problems())
        for one, other in itertools.combinations(self.factors, 2):
            for path in self.factors[one].sets.keys() & self.factors[other].sets.keys():
                yield f"factors.{other}.sets.{path}: is set by {one} as well, must be by one alone"


class PlanPart(Section):
    """One small study for some of the claims."""

    claims: Annotated[list[Claim], UNIQUE] = Field(min_length=1, max_length=12)
    """Those that the part is to judge, each for all its parts."""
    study: Variation


class SampledPart(PlanPart):
    """One small study for some of the claims, in a number of samples."""

    samples: Annotated[
        Literal[2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096], Form("a power of two from 2 to 4096")
    ]
    """A power of two for the balance of the Sobol sequence."""


class RobustnessPlan(DrawnPlan):
    """Factors that vary, and small studies for some of the claims (studies/variations)."""

    parts: dict[Name, SampledPart] = Field(min_length=1, max_length=100)
    """Small studies, by name."""

    def problems(self) -> Iterator[str]:
        """Yield what the models cannot say."""
        yield from super().problems()
        for (one, part), (other, further) in itertools.combinations(self.parts.items(), 2):
            if both := set(part.claims) & set(further.claims):
                yield f"parts.{other}.claims: {min(both)} is judged by {one} as well, must be by one alone"


class CandidateSettings(Section):
    """The sets in which most parts of claims hold, judged by all claims."""

    number: int = Field(ge=1, le=1000)
    """Of all waves."""
    neighbours: int = Field(ge=0, le=100)
    """Of each candidate."""
    shift: Number = Field(gt=0, le=0.5)
    """Of every factor of a neighbour, up or down, as a share of its range."""
    study: Variation

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """Candidate and neighbour of each finer study; candidate 0 has the study's own values."""
        return list(itertools.product(range(self.number + 1), range(self.neighbours + 1)))


class IdentificationPlan(DrawnPlan):
    """Values of what the paper does not print, in waves (studies/variations)."""

    parts: dict[Name, PlanPart] = Field(min_length=1, max_length=100)
    """Small studies that each set makes, by name."""
    sets: dict[Name, dict[Name, Value]] = Field(max_length=1000)
    """Sets of the first wave beside the study's own, by name: values of some factors, of the first number
    that each sets, within its range; the study's own of the others."""
    waves: list[Annotated[int, Field(ge=1, le=4096)]] = Field(min_length=1, max_length=20)
    """Number of sets drawn in each."""
    remaining: Number = Field(gt=0, le=1)
    """Share of the volume of the ranges that must be left; targets are given up, as few as possible, until it
    is."""
    candidates: CandidateSettings

    def problems(self) -> Iterator[str]:
        """Yield what the models cannot say."""
        yield from super().problems()
        for name, values in self.sets.items():
            for factor, value in values.items():
                message = f"sets.{name}.{factor} = {format_value(value)}: must be"
                if factor not in self.factors:
                    yield f"{message} of a factor: {', '.join(self.factors)}"
                    continue
                low, high = self.factors[factor].range
                if not low <= value <= high:
                    yield f"{message} from {low:g} to {high:g}, the range of the factor"
        given = 1 + len(self.sets)
        if (least := FEWEST - given) > self.waves[0]:
            text = f"the first must be at least {least}, or no target has an emulator after it"
            yield f"waves = {format_value(self.waves)}: {text}"
        if (number := self.candidates.number) > (most := sum(self.waves) + given - 1):
            text = f"must be at most {most}, the sets of all waves but the study's"
            yield f"candidates.number = {number}: {text}"
