"""Quantities that several sections have: of a coating, of a casing, and speeds."""

from typing import Annotated, Literal

from pydantic import Field

from bladerub.settings.fields import (
    UNIQUE,
    Degree,
    Form,
    Limit,
    Modulus,
    Number,
    OneOf,
    Radian,
    ScaledMetre,
    Speed,
)

CasingName = Annotated[
    str,
    OneOf("casings"),
    Form("the name of one of the casings"),
    Field(pattern=r"^[A-Za-z0-9]+$", description="One of the keys of casings."),
]
YoungModulus = Annotated[
    Modulus, Field(gt=0, le=1e6, description="Of the coating; the paper's go from 0.11 to 20.")
]
PlasticModulus = Annotated[
    Modulus, Field(ge=0, le=1e6, description="Hardening of the coating; 0 is perfectly plastic.")
]
Theta = Annotated[
    Radian,
    Field(
        ge=0,
        le=1.5,
        description="Angle of the abradable elements from the radial direction; above 0 the contact force "
        "has a tangential part.",
    ),
]
Friction = Annotated[
    Number,
    Field(
        ge=0,
        le=1,
        description="Coulomb's coefficient, of the blade on the coating or on the rigid casing; its arc "
        "tangent turns the contact force as theta does, against the sliding of the blade over the casing.",
    ),
]
Rigid = Annotated[
    Literal["rigid"],
    Form("rigid; an abradable coating has no such key"),
    Field(description="The limit of E and K that grow together."),
]
DampingRatio = Annotated[
    Number,
    Field(
        ge=0,
        lt=1,
        description="Of every mode; usual for a titanium blade in its root. Determines the height of the "
        "peaks.",
    ),
]
LayerThickness = Annotated[
    ScaledMetre,
    Field(
        ge=1e-4,
        le=0.1,
        description="Of the abradable layer, usual for a low-pressure compressor; strain is penetration "
        "over this.",
    ),
]
Interference = Annotated[
    ScaledMetre,
    Field(
        gt=0,
        le=0.05,
        description="Depth by which the shape of the casing overlaps the blade tip before the clearance; "
        "its ratio to the amplitude determines the part of a revolution in contact.",
    ),
]
RunSpeed = Annotated[
    Speed,
    Limit("at most", "reduction.f_omega_max", "the reduced blade is not valid above"),
    Field(ge=0.001, le=2, description="Rotational frequency; at lower speeds a run takes long."),
]
StartAngle = Annotated[
    Degree,
    Field(
        ge=-360,
        le=360,
        description="Casing angle under the blade at the start; where the gap is widest (180/n for n nodal "
        "diameters).",
    ),
]
EngineOrder = Annotated[
    int,
    Limit("at most", "analysis.max_order"),
    Field(ge=1, le=1000, description="Vibrations in one revolution."),
]
EngineOrders = Annotated[list[EngineOrder], UNIQUE, Field(min_length=1, max_length=1000)]

QUANTITIES = {
    "E": YoungModulus,
    "K": PlasticModulus,
    "theta": Theta,
    "friction": Friction,
    "damping_ratio": DampingRatio,
    "layer_thickness": LayerThickness,
    "interference": Interference,
    "f_omega": RunSpeed,
}
"""What a coating and a run are described by, by the names of arguments and options."""
