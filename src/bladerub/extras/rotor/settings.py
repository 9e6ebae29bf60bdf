"""What a plan of rows of blades holds."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.coatings import CasingName, PlasticModulus, RunSpeed, Theta, YoungModulus
from bladerub.settings.fields import Metre, Name, Number, Omitted, Section, Seed

_SOME = Field(min_length=1, max_length=100)


class Group(Section):
    """Rows on one coating, for each combination of the lists."""

    casing: CasingName
    E: YoungModulus
    K: PlasticModulus
    theta: Theta
    f_omega: list[RunSpeed] = _SOME
    """Constant speeds."""
    blades: list[Annotated[int, Field(ge=1, le=200)]] = _SOME
    """Their numbers, at even angles. Neighbours must not meet within the displacement limit."""
    length_scatter: list[Annotated[Metre, Field(ge=0, le=0.01)]] = _SOME
    """Standard deviations of the tip radii, of normal distributions."""
    frequency_scatter: list[Annotated[Number, Field(ge=0, le=0.1)]] = _SOME
    """Relative standard deviations of the natural frequencies; one draw for all modes of a blade."""
    coupling: list[Annotated[Number, Field(ge=0, le=10)]] = _SOME
    """Springs between neighbours over the stiffness of the first mode; 0 is a stiff disk."""
    draws: int = Field(ge=1, le=10000)
    """Rows of each combination whose blades differ; identical blades are one row."""


class Patterns(Section):
    """Rows whose worn pattern is followed as it deepens, with their single blades."""

    harmonic: int = Field(ge=1, le=100)
    """Lobes of the pattern; such as the engine order of the peak."""
    interval: int = Field(ge=1, le=1000)
    """Revolutions between two looks at the wear."""
    groups: dict[Name, Group] = _SOME
    """As those of the plan, by name."""


class RotorPlan(Section):
    """Groups of rows of blades on one coating (studies/rotor/README.md)."""

    seed: Seed
    """Of the first draw; each further one adds 1."""
    groups: dict[Name, Group] = _SOME
    """Each stands for all combinations of its lists, by name."""
    sweeps: Omitted[dict[Name, Group]] = Field(None, max_length=100)
    """Groups whose rows are compared over their speeds, by name."""
    patterns: Omitted[Patterns] = None
