"""What plans of designs have in common: factors, claims, and what is laid over the study."""

from typing import Annotated, Any, Literal

from pydantic import Field

from bladerub.config.fields import ASCENDING, UNIQUE, Form, Name, Number, Omitted, Section

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
