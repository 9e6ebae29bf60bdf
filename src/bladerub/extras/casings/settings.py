"""What a config says of a casing whose gap was measured."""

from typing import Annotated, Literal

from pydantic import Field

from bladerub.settings.contact import AnyCasing, CasingInterference
from bladerub.settings.fields import Form, Omitted, Section


class GapTable(Section):
    """A text with the columns angle and gap, named in its first row.

    The gap is what contact.clearance is added to, negative where tip and coating overlap, at angles that
    count in the direction of rotation. ``contact.scale`` does not apply to it.
    """

    file: Annotated[str, Form("the path of a file that ends in .csv, .txt or .dat")] = Field(
        pattern=r"^.+\.([cC][sS][vV]|[tT][xX][tT]|[dD][aA][tT])$"
    )
    """Relative to the folder that Snakemake runs in."""
    unit: Omitted[Literal["m", "mm", "cm", "inch", "in", "feet", "ft"]] = None
    """Of the gap; m if it is not given."""
    angle_unit: Omitted[Literal["rad", "deg"]] = None
    """deg if it is not given."""


class MeasuredCasing(AnyCasing):
    """Shape of one casing by a table of the gap around it."""

    table: GapTable
    interference: Omitted[CasingInterference] = None
