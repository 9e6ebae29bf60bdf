"""Which coatings are run by both laws of friction."""

from typing import Annotated

from pydantic import Field

from bladerub.settings.coatings import CasingName, PlasticModulus, Theta, YoungModulus
from bladerub.settings.fields import Section

_SOME = Field(min_length=1, max_length=20)


class ComparedCoatings(Section):
    """Abradable coatings of one casing, by both laws of friction."""

    casing: CasingName
    E: list[YoungModulus] = _SOME
    """From the ridge of the response to the stiffest of the paper."""
    K: list[PlasticModulus] = _SOME
    """Where the response is highest."""
    theta: list[Theta] = _SOME
    """The 0.15 of Fig. 16, and twice that."""


FRICTION = Annotated[
    list[ComparedCoatings],
    Field(
        default=[ComparedCoatings(casing="2nd", E=[1.1, 2, 20], K=[0.5], theta=[0.15, 0.3])],
        max_length=100,
        description="Coatings that `snakemake friction` runs by both laws of friction "
        "(studies/friction/README.md). Each entry stands for all combinations; none need be in coatings.",
    ),
]
