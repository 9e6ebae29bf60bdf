"""What a config says of a calibration, and what the plans of variations hold."""

import itertools
from typing import Annotated, Any, Literal

from pydantic import Field

from bladerub.settings.fields import ASCENDING, UNIQUE, ConfigFile, Form, Name, Number, Omitted, Section, Seed

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
Claims = Annotated[
    list[Annotated[str, Field(pattern=r"^C([1-9]|1[0-2])$"), Form("a claim of the paper, C1 to C12")]],
    UNIQUE,
    Field(
        min_length=1, max_length=12, description="Those that the part is to judge, each for all its parts."
    ),
]
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


class FactorSettings(Section):
    """One choice that the paper leaves open, which sets one or more numbers of the config."""

    unit: str = Field(min_length=1, max_length=40)
    """Of the values, as in the table of the samples."""
    scale: Omitted[Literal["linear", "log"]] = None
    """On which the samples are spread evenly; linear unless it says otherwise."""
    multiple_of: Omitted[Number] = Field(None, gt=0, le=1e12)
    """Values are rounded to a multiple of it."""
    sets: dict[
        str,
        Annotated[
            list[Annotated[Number, Field(ge=-1e12, le=1e12)]], ASCENDING, Field(min_length=2, max_length=2)
        ],
    ] = Field(min_length=1, max_length=100)
    """Path of each number in the config, such as casings.2nd.weights[0], with its lowest and highest
    value."""


Factors = Annotated[
    dict[Name, FactorSettings],
    Field(min_length=1, max_length=100, description="Choices that the paper leaves open, by name."),
]


class PlanPart(Section):
    """One small study for some of the claims."""

    claims: Claims
    study: Variation


class SampledPart(PlanPart):
    """One small study for some of the claims, in a number of samples."""

    samples: Annotated[
        Literal[2, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096], Form("a power of two from 2 to 4096")
    ]
    """A power of two for the balance of the Sobol sequence."""


class RobustnessPlan(Section):
    """Factors that vary, and small studies for some of the claims (studies/variations)."""

    seed: Seed
    """Of the scrambling of the Sobol sequence."""
    factors: Factors
    parts: dict[Name, SampledPart] = Field(min_length=1, max_length=100)
    """Small studies, by name."""


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


class IdentificationPlan(Section):
    """Values of what the paper does not print, in waves (studies/variations)."""

    seed: Seed
    """Of everything that is drawn."""
    factors: Factors
    parts: dict[Name, PlanPart] = Field(min_length=1, max_length=100)
    """Small studies that each set makes, by name."""
    sets: dict[Name, dict[Name, Annotated[Number, Field(ge=-1e12, le=1e12)]]] = Field(max_length=1000)
    """Sets of the first wave beside the study's own, by name: values of some factors, of the first number
    that each sets, within its range; the study's own of the others."""
    waves: list[Annotated[int, Field(ge=1, le=4096)]] = Field(min_length=1, max_length=20)
    """Number of sets drawn in each."""
    remaining: Number = Field(gt=0, le=1)
    """Share of the volume of the ranges that must be left; targets are given up, as few as possible, until it
    is."""
    candidates: CandidateSettings
