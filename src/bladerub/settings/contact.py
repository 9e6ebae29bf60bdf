"""Contact: coating, tip and clearance, and the shapes of the casings."""

from collections.abc import Mapping
from typing import Annotated, Any, Union

from pydantic import Discriminator, Field, Tag, model_validator

from bladerub.settings.analysis import EngineOrders
from bladerub.settings.coatings import DampingRatio, Interference, LayerThickness
from bladerub.settings.fields import (
    UNIQUE,
    BladeLengths,
    Degree,
    Form,
    Limit,
    Modulus,
    Number,
    Omitted,
    Pascal,
    ScaledMetre,
    Section,
    Unit,
    disagreement,
)


class TipProfile(Section):
    """Parabola under each interface node, Fig. 3 of the paper."""

    half_width: Annotated[
        float,
        Unit("elements"),
        Limit("at most", "contact.elements", "the tip of a blade is narrow", divisor=8),
    ] = Field(ge=0.5, le=20)
    """The whole width is about the thickness of the blade at its tip."""
    edge_drop: ScaledMetre = Field(ge=0, le=0.01)
    """How much lower the edge of the tip is than its middle; determines the width of the track."""


class Clearance(Section):
    """The paper's 0.015 % to 0.043 % of the blade length, linear along the chord."""

    leading_edge: BladeLengths = Field(ge=0, le=0.05)
    """Lower end of the paper's range."""
    trailing_edge: BladeLengths = Field(ge=0, le=0.05)
    """Upper end of the paper's range."""


class Contact(Section):
    """Coating, tip and clearances, but for what each coating varies."""

    modulus_unit: Pascal = Field(ge=1000, le=1e12)
    """What E = 1 and K = 1 are. Not given by the paper; fitted so that the peaks are at the paper's
    speeds."""
    yield_stress: Modulus = Field(ge=0, le=100)
    """Elastic limit σ_Y, the paper's value: zero in practice."""
    layer_thickness: LayerThickness
    elements: int = Field(ge=100, le=100000)
    """Around the circumference, the paper's 2,000."""
    tip_profile: TipProfile
    tip_turns: Omitted[bool] = None
    """Whether the profile of Fig. 3 turns with the tip as the blade bends, and the blade feels the couple of
    the contact forces; false where it is left out. The paper does not mention it. Direct contact with the
    rigid casing has no profile."""
    clearance: Clearance
    damping_ratio: DampingRatio


CasingInterference = Annotated[
    Interference, Limit("below", "contact.layer_thickness", "or the blade reaches through the coating")
]


class AnyCasing(Section):
    """What every casing has."""

    interference: CasingInterference
    start_angle: Degree = Field(ge=-360, le=360)
    """Casing angle under the blade at the start; where the gap is widest (180/n for n nodal diameters)."""
    peak_orders: Omitted[EngineOrders] = None
    """Instead of analysis.peaks.orders. If it is left out and the casing does not excite those, its peaks are
    at two other orders (docs/how-to/vary_the_study.md)."""


class Casing(AnyCasing):
    """Shape of one casing, a sum of waves, or of bumps."""

    nodal_diameters: Annotated[
        list[Annotated[int, Limit("at most", "contact.elements", divisor=2), Field(ge=1, le=100)]], UNIQUE
    ] = Field(min_length=1, max_length=20)
    """Numbers of full waves around the circumference. The paper distorts the casing along 2 and 5."""
    weights: list[Annotated[Number, Field(ge=-100, le=100)]] = Field(min_length=1, max_length=20)
    """One for each nodal diameter; the sum is scaled to a maximum of 1. Not given by the paper; chosen for
    the lobes of Fig. 6."""
    amplitude: ScaledMetre = Field(gt=0, le=0.05)
    """The paper's "one millimetre" for 2 nodal diameters; half of it for 2 + 5, where a smaller one gives the
    lobes of Fig. 6."""
    bump_width: Omitted[Number] = Field(None, gt=0, le=1)
    """Each nodal diameter n then stands for n Gaussian bumps instead of n waves; over the distance between
    two of them."""

    @model_validator(mode="after")
    def _weights_fit(self) -> "Casing":
        number = len(self.nodal_diameters)
        if len(self.weights) != number:
            raise disagreement("weights", f"must be {number}, one for each of nodal_diameters")
        if not any(self.weights):
            raise disagreement("weights", "at least one must not be 0")
        return self


CasingNames = Annotated[
    str,
    Field(pattern=r"^[A-Za-z0-9]+$", max_length=40),
    Form("at most 40 letters and digits, it becomes part of file names"),
]


def casings(kinds: Mapping[str, type[Section]]) -> Any:
    """Make the type of the group, with `kinds` beside `Casing` by a key that they alone have."""

    def tag(entry: Any) -> str:
        keys = entry.plain() if isinstance(entry, Section) else entry
        return next((key for key in kinds if isinstance(keys, Mapping) and key in keys), "sum")

    models = {"sum": Casing, **kinds}
    union = Union[tuple(Annotated[model, Tag(name)] for name, model in models.items())]  # noqa: UP007
    return Annotated[
        dict[CasingNames, Annotated[union, Discriminator(tag)] if kinds else Casing],
        Field(
            min_length=1, max_length=100, description="Rigid inner shapes, by short names as in the paper."
        ),
    ]
