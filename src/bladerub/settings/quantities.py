"""Quantities that several sections have: of a coating, of a casing, and speeds."""

from typing import Annotated, Literal

from pydantic import Field

from bladerub.settings.fields import (
    UNIQUE,
    Form,
    Limit,
    Modulus,
    Number,
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
YoungModulus, PlasticModulus, Theta, Friction, *_ = QUANTITIES.values()
*_, DampingRatio, LayerThickness, Interference, RunSpeed = QUANTITIES.values()

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
EngineOrder = Annotated[
    int,
    Limit("at most", "analysis.max_order"),
    Field(ge=1, le=1000, description="Vibrations in one revolution."),
]
EngineOrders = Annotated[list[EngineOrder], UNIQUE, Field(min_length=1, max_length=1000)]
