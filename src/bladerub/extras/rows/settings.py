"""What a config says of a row of blades."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.fields import Metre, Number, Omitted, Radian, Section, Seed

_SOME = Field(None, min_length=1, max_length=200)


class Rotor(Section):
    """A row of blades that rub on one coating (docs/how-to/row_of_blades.md).

    Left out, a run is of a single blade. A list has a value for each blade, or one for all of them.
    """

    blades: int = Field(ge=1, le=200)
    """At even angles. Neighbours must not meet within the displacement limit."""
    length: Omitted[list[Annotated[Metre, Field(ge=-0.01, le=0.01)]]] = _SOME
    """Tip radii beyond the nominal one."""
    frequency: Omitted[list[Annotated[Number, Field(ge=-0.5, le=0.5)]]] = _SOME
    """Relative deviations of the natural frequencies, the same for all modes of a blade."""
    damping: Omitted[list[Annotated[Number, Field(ge=0, le=100)]]] = _SOME
    """Damping ratios over that of the run."""
    angle_error: Omitted[list[Annotated[Radian, Field(ge=-0.5, le=0.5)]]] = _SOME
    """Angles ahead of the even ones."""
    coupling: Omitted[list[Annotated[Number, Field(ge=0, le=10)]]] = _SOME
    """Springs between neighbours over the stiffness of the first modes, a value for each mode."""
    length_scatter: Omitted[Metre] = Field(None, ge=0, le=0.01)
    """Standard deviation of draws that are added to the tip radii."""
    frequency_scatter: Omitted[Number] = Field(None, ge=0, le=0.1)
    """Relative standard deviation of draws that are added to the deviations of the frequency."""
    seed: Omitted[Seed] = None
    """Of the draws; 1 where it is left out."""
