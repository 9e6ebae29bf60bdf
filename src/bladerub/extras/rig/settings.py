"""What a plan of rigs holds."""

from typing import Annotated

from pydantic import Field

from bladerub.extras.law_settings import Law
from bladerub.settings.fields import Form, Metre, Name, Omitted, Pascal, Radian, Section, Unit


class RigSettings(Section):
    """A rigid tip, a coated disk and what is between them."""

    E: Pascal = Field(ge=1000, le=1e13)
    """Of the coating, not normalised."""
    K: Pascal = Field(ge=0, le=1e13)
    """Of the coating, not normalised."""
    yield_stress: Pascal = Field(ge=0, le=1e12)
    """Elastic limit of the coating, not normalised."""
    thickness: Metre = Field(ge=1e-6, le=1)
    """Of the whole layer."""
    tip_width: Metre = Field(ge=1e-6, le=1)
    """Across the track."""
    tip_length: Metre = Field(ge=1e-6, le=1)
    """Along the track."""
    track: Metre = Field(ge=0.001, le=1000)
    """The circumference, from one pass to the next."""
    speed: Annotated[float, Unit("m/s")] = Field(ge=1e-6, le=10000)
    """Of the tip along the track."""
    incursion: Metre = Field(ge=1e-9, le=1)
    """By which the tip is fed at each pass."""
    theta: Radian = Field(ge=0, le=1.5)
    """Angle of the contact force from the normal, against the motion."""
    edge_drop: Metre = Field(ge=0, le=1)
    """How much lower the edges of the tip are than its middle."""
    coated: Metre = Field(ge=0, le=1000)
    """Length of the coating along the track; 0 for the whole track."""
    passes: int = Field(ge=1, le=100000)
    """The first is at the depth of one incursion."""
    law: Omitted[Law] = None
    source: Annotated[Omitted[str], Form("a text of at most 300 letters")] = Field(
        None, pattern=r"^.{0,300}$"
    )
    """Where inputs and measured values are from."""
    assumed: list[
        Annotated[str, Field(pattern=r"^[A-Za-z_]{1,40}$"), Form("the name of a parameter of a rig")]
    ]
    """Names of the parameters that the source does not give."""
    measured: Omitted[dict[str, Annotated[float, Unit("as in the table"), Field(ge=-1e15, le=1e15)]]] = None
    """Of the last pass, by the columns of results/tables/rigs.csv."""


class RigPlan(Section):
    """Rub rigs, a rigid tip on a coated disk (docs/laws.md)."""

    rigs: dict[Name, RigSettings] = Field(min_length=1, max_length=100)
    """By name."""
