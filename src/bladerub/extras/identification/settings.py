"""What a plan of an identification holds."""

from typing import Annotated

from pydantic import Field

from bladerub.config.fields import Name, Number, Section, Seed
from bladerub.extras.design import Claims, Factors, Variation


class IdentificationPart(Section):
    """One small study for some of the claims."""

    claims: Claims
    study: Variation


class CandidateSettings(Section):
    """The sets in which most parts of claims hold, judged by all claims."""

    number: int = Field(ge=1, le=1000)
    """Of all waves."""
    neighbours: int = Field(ge=0, le=100)
    """Of each candidate."""
    shift: Number = Field(gt=0, le=0.5)
    """Of every factor of a neighbour, up or down, as a share of its range."""
    study: Variation


class IdentificationPlan(Section):
    """Sets of values of what the paper does not print, in waves (studies/identification/README.md)."""

    seed: Seed
    """Of everything that is drawn."""
    factors: Factors
    parts: dict[Name, IdentificationPart] = Field(min_length=1, max_length=100)
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
