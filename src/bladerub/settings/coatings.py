"""Coatings of the study: abradable ones, those with Coulomb friction, and direct contact with the casing.

First the quantities that a coating and a run are described by, which other sections have as well.
"""

from collections.abc import Mapping
from typing import Annotated, Any, Literal, TypeVar

from pydantic import Discriminator, Field, Tag

from bladerub.settings.fields import (
    Form,
    Limit,
    Modulus,
    Number,
    Omitted,
    OneOf,
    Radian,
    ScaledMetre,
    Section,
    Speed,
)


class Quantities(Section):
    """What a coating and a run are described by, by the names of arguments and options."""

    E: Modulus = Field(gt=0, le=1e6)
    """Of the coating; the paper's go from 0.11 to 20."""
    K: Modulus = Field(ge=0, le=1e6)
    """Hardening of the coating; 0 is perfectly plastic."""
    theta: Radian = Field(ge=0, le=1.5)
    """Angle of the abradable elements from the radial direction; above 0 the contact force has a tangential
    part."""
    friction: Number = Field(ge=0, le=1)
    """Coulomb's coefficient, of the blade on the coating or on the rigid casing; its arc tangent turns the
    contact force as theta does, against the sliding of the blade over the casing."""
    damping_ratio: Number = Field(ge=0, lt=1)
    """Of every mode; usual for a titanium blade in its root. Determines the height of the peaks."""
    layer_thickness: ScaledMetre = Field(ge=1e-4, le=0.1)
    """Of the abradable layer, usual for a low-pressure compressor; strain is penetration over this."""
    interference: ScaledMetre = Field(gt=0, le=0.05)
    """Depth by which the shape of the casing overlaps the blade tip before the clearance; its ratio to the
    amplitude determines the part of a revolution in contact."""
    f_omega: Annotated[
        Speed, Limit("at most", "reduction.f_omega_max", "the reduced blade is not valid above")
    ] = Field(ge=0.001, le=2)
    """Rotational frequency; at lower speeds a run takes long."""


QUANTITIES = {
    name: Annotated[info.annotation, *info.metadata, Field(description=info.description)]
    for name, info in Quantities.model_fields.items()
}
"""Types of them, for the keys of sections."""
YoungModulus, PlasticModulus = QUANTITIES["E"], QUANTITIES["K"]
Theta, Friction = QUANTITIES["theta"], QUANTITIES["friction"]
DampingRatio, RunSpeed = QUANTITIES["damping_ratio"], QUANTITIES["f_omega"]
LayerThickness, Interference = QUANTITIES["layer_thickness"], QUANTITIES["interference"]

CasingName = Annotated[
    str,
    OneOf("casings"),
    Form("the name of one of the casings"),
    Field(pattern=r"^[A-Za-z0-9]+$", description="One of the keys of casings."),
]
Rigid = Annotated[
    Literal["rigid"],
    Form("rigid; an abradable coating has no such key"),
    Field(description="The limit of E and K that grow together."),
]
_SEVERAL = Field(min_length=1, max_length=1000)
_VARIED = Field(
    None, min_length=1, max_length=1000, description="Instead of that of the config; each makes a coating."
)


class OnCasing(Section):
    """What all coatings have, and the runs of one."""

    casing: CasingName


class RigidCoating(OnCasing):
    """Direct contact with one casing, which neither deforms nor wears."""

    coating: Rigid
    friction: list[Friction] = _SEVERAL
    """0, for comparison with coatings of theta = 0."""
    damping_ratio: Omitted[list[DampingRatio]] = _VARIED
    interference: Omitted[list[Interference]] = _VARIED


class _Layers(OnCasing):
    E: list[YoungModulus] = _SEVERAL
    """The nine of the paper, and a softer one."""
    K: list[PlasticModulus] = _SEVERAL
    """The paper names 0.1, 0.5, 1 and 5; the others complete its histograms."""
    damping_ratio: Omitted[list[DampingRatio]] = _VARIED
    layer_thickness: Omitted[list[LayerThickness]] = _VARIED
    interference: Omitted[list[Interference]] = _VARIED


class Coating(_Layers):
    """Abradable coatings of one casing."""

    theta: list[Theta] = _SEVERAL
    """0, and the 0.15 of Fig. 16."""


class CoatingWithFriction(_Layers):
    """Abradable coatings of one casing, with Coulomb friction."""

    friction: list[Friction] = _SEVERAL
    """The tangent of theta, for comparison; the study has none."""


class _Run(OnCasing):
    f_omega: Speed = Field(ge=0.001, le=2)
    """One of the speeds of the study; of the paper's histories, those at others are left out."""
    damping_ratio: Omitted[DampingRatio] = None
    interference: Omitted[Interference] = None


class HistoryOfDirectContact(_Run):
    """One run of the grid on the rigid casing."""

    coating: Rigid
    friction: Friction


class _LayerRun(_Run):
    E: YoungModulus
    K: PlasticModulus
    layer_thickness: Omitted[LayerThickness] = None


class History(_LayerRun):
    """One run of the grid on an abradable coating."""

    theta: Theta


class HistoryWithFriction(_LayerRun):
    """One run of the grid on an abradable coating with Coulomb friction."""

    friction: Friction


def _kind(entry: Any) -> str | None:
    """Tell the kinds of coating apart; none of an entry whose key `coating` is not ``rigid``."""
    if isinstance(entry, Section):
        entry = entry.plain()
    if not isinstance(entry, Mapping):
        return "layer"
    if "coating" in entry:
        return "rigid" if entry["coating"] == "rigid" else None
    return "friction" if "friction" in entry else "layer"


Layer = TypeVar("Layer")
WithFriction = TypeVar("WithFriction")
Direct = TypeVar("Direct")
_Entry = Annotated[
    Annotated[Layer, Tag("layer")]
    | Annotated[WithFriction, Tag("friction")]
    | Annotated[Direct, Tag("rigid")],
    Discriminator(
        _kind,
        custom_error_type="kind",
        custom_error_message="must be rigid; an abradable coating has no such key",
        custom_error_context={"within": "coating"},
    ),
]
Coatings = list[_Entry[Coating, CoatingWithFriction, RigidCoating]]
Histories = list[_Entry[History, HistoryWithFriction, HistoryOfDirectContact]]
