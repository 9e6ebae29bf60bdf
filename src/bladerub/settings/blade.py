"""The blade and its reduction."""

import math
from typing import Annotated

from pydantic import AfterValidator, Field

from bladerub.settings.fields import BladeLengths, Degree, Metre, Number, Omitted, Pascal, Section, Unit


class Material(Section):
    """Ti-6Al-4V, usual for the front stages of a low-pressure compressor."""

    young_modulus: Pascal = Field(ge=1e8, le=1e12)
    """At room temperature; the range goes from plastics to ceramics."""
    poisson_ratio: Number = Field(ge=0, le=0.49)
    """At 0.5 the material would be incompressible and the elements lock."""
    density: Annotated[float, Unit("kg/m³")] = Field(ge=500, le=25000)
    """Titanium alloy."""


class SpanSection(Section):
    """One profile of the blade."""

    span: BladeLengths = Field(ge=0, le=1)
    """0 at the hub, 1 at the tip."""
    chord: Metre = Field(ge=0.001, le=2)
    """Distance from the leading to the trailing edge."""
    thickness: Annotated[float, Unit("chords")] = Field(ge=0.005, le=0.4)
    """Largest thickness over chord; thinner than 0.5 % no blade is made."""
    camber: Degree = Field(ge=-120, le=120)
    """How much the mean line turns from the leading to the trailing edge."""
    stagger: Degree = Field(ge=-85, le=85)
    """Angle between chord and axis; at 90 degrees the blade would not reach along the axis."""
    sweep: Metre = Field(ge=-1, le=1)
    """Axial offset of the section; with the lean it balances the centrifugal bending."""
    lean: Metre = Field(ge=-1, le=1)
    """Tangential offset of the section; with the sweep it balances the centrifugal bending."""


class Mesh(Section):
    """Number of 20-node hexahedra in each direction."""

    chordwise: int = Field(ge=4, le=200)
    """The tip must have room for eight interface nodes, and the first mode must have converged."""
    thickness: int = Field(ge=1, le=20)
    """Quadratic elements bend well with one or two."""
    spanwise: int = Field(ge=2, le=400)
    """Enough for the ten modes of the accuracy table."""


class Blade(Section):
    """Parametric stand-in for the confidential blade of the paper: its first frequency rises alike."""

    material: Material
    hub_radius: Metre = Field(ge=0.01, le=5)
    """Its ratio to the length determines how much rotation stiffens the blade, and so how steep C1 is."""
    length: Metre = Field(ge=0.01, le=3)
    """The first frequency is proportional to its inverse; clearances are given in this unit. With a source,
    that of the file to within 5 %."""
    tip_cone: Degree = Field(ge=-45, le=45)
    """Half angle of the flow path at the tip, positive where tip and casing widen downstream; with the
    stagger it determines how far bending moves the tip from the casing."""
    sections: list[SpanSection] = Field(min_length=2, max_length=50)
    """From hub to tip; the shape between two sections is interpolated."""
    mesh: Mesh


def _rounded_up(f_omega: float) -> float:
    """Round a speed up to the six decimals that speeds of a study are rounded to."""
    return math.ceil(round(f_omega * 1e6, 3)) / 1e6


class Reduction(Section):
    """Craig-Bampton reduction with centrifugal stiffening, eqs. (2) to (6) of the paper."""

    f_omega_max: Annotated[float, Unit("f1"), AfterValidator(_rounded_up)] = Field(ge=0.01, le=2)
    """Highest speed of the reduced model: upper end of the paper's range. K(f) is fitted at 0, half of it and
    it."""
    modes_per_speed: int = Field(ge=1, le=50)
    """Fixed-interface modes at each speed of the fit. The paper's η = 6, enough for seven modes."""
    fit_speeds: Omitted[int] = Field(None, ge=3, le=7)
    """Number of speeds of the fit, evenly from 0 to f_omega_max. 3 if not given, those of eq. (3); with more,
    eq. (2) continues with the next even powers."""
    tolerance: Omitted[Number] = Field(None, ge=1e-5, le=0.5)
    """Error allowed to the first six frequencies of the reduced model at the accuracy speeds; if given,
    fit_speeds and modes_per_speed are increased until it holds."""
    interface_nodes: Omitted[int] = Field(None, ge=4, le=32)
    """Nodes of the tip that may touch, from the leading to the trailing edge; the paper's 8 if not given.
    Matrices bring their own. What more of them change: studies/convergence/README.md."""
    rank_tolerance: Number = Field(ge=1e-12, le=0.1)
    """Relative singular value below which a column of eq. (4) is linearly dependent on the others."""
    accuracy_speeds: int = Field(ge=2, le=200)
    """Number of speeds of the accuracy table. With 2 or 3 of them the error of eq. (2) is not known, which is
    exact at the speeds of its fit."""
    accuracy_modes: int = Field(ge=1, le=50)
    """Modes of the accuracy table. The paper shows seven that agree; ten show where agreement ends."""


class BladeSpec(Section):
    """All that a reduced blade is built from."""

    blade: Blade
    reduction: Reduction
