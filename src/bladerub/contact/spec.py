"""What one run is, in SI units unless said to be normalised."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Casing:
    """Inner shape of the rigid casing: waves or bumps of given weight, or as measured.

    The gap of node j at casing angle φ is ``c_j + (a − δ) − a s(φ)`` with the shape ``s``, whose maximum is 1
    (`bladerub.contact.casing.shape`).
    """

    name: str  # as in the config, for instance "2nd"
    nodal_diameters: tuple[int, ...]  # n of each term: so many waves, or bumps, around the circumference
    weights: tuple[float, ...]  # of each term
    amplitude: float  # largest inward displacement a, m
    interference: float  # depth δ by which the shape reaches over the blade tip, before the clearance, m
    start_angle: float  # casing angle under the stacking line at the start of the run, rad
    bump_width: float = 0.0  # of Gaussian bumps instead of waves, over their distance; 0 for waves
    measured: tuple[tuple[float, float], ...] = ()  # instead of terms: angles, rad, ascending, and the shape


@dataclass(frozen=True)
class ElementLaw:
    """Law of the abradable elements."""

    name: str = "plastic"  # that of the paper, or one that plugs in (`bladerub.contact.laws`)
    parameters: tuple[tuple[str, float], ...] = ()  # names and values of those beside E, K and σ_Y, SI units
    source: str = ""  # text of a module that is not of this package

    @property
    def label(self) -> str:
        """Name and values, for instance ``viscoplastic (viscosity 10000)``."""
        values = ", ".join(f"{name} {value:g}" for name, value in self.parameters)
        return f"{self.name} ({values})" if values else self.name


PLASTIC = ElementLaw()  # one-dimensional plasticity with linear hardening (Fig. 4)


@dataclass(frozen=True)
class Coating:
    """Abradable layer: E, K and σ_Y normalised by `modulus_unit`.

    Infinite E and K stand for direct contact with the rigid casing: it neither deforms nor wears. The contact
    force is turned by θ against the rotation, which is also the angle of friction: Coulomb's coefficient is
    tan θ. By the law ``"theta"`` its direction is constant, by ``"coulomb"`` its tangential part opposes the
    sliding of each node over the casing (`bladerub.contact.friction`).
    """

    E: float  # Young modulus and plastic (hardening) modulus, normalised; both finite or both infinite
    K: float
    theta: float  # rotation θ of the abradable elements from the radial direction, rad
    yield_stress: float  # elastic limit σ_Y, normalised
    modulus_unit: float  # of the normalised moduli, Pa
    thickness: float  # of the layer, m
    n_elements: int  # abradable elements around the circumference, for each interface node
    law: str = "theta"  # or "coulomb"
    element_law: ElementLaw = PLASTIC  # of force and wear along the elements

    @property
    def is_rigid(self) -> bool:
        """Whether this is direct contact with the rigid casing."""
        return math.isinf(self.E) and math.isinf(self.K)

    @property
    def coulomb(self) -> bool:
        """Whether the tangential force follows the sliding."""
        return self.law == "coulomb"


@dataclass(frozen=True)
class TipProfile:
    """Circumferential profile of the blade tip under one interface node (Fig. 3): a parabola."""

    half_width: float  # tangential, in element widths
    edge_drop: float  # how much lower the edge is than the middle, m
    turns: bool = False  # with the blade tip; direct contact with the rigid casing has no profile

    @property
    def curvature(self) -> float:
        """Drop at a distance of one element, m."""
        return self.edge_drop * (1.0 / self.half_width) ** 2


@dataclass(frozen=True)
class RunSpec:
    """One simulation: one coating at one speed.

    The time step follows from the tolerance (`bladerub.contact.steps`), unless the run says how many steps
    the passage of one coating element takes at least, or how long they are at most.
    """

    casing: Casing
    coating: Coating
    tip: TipProfile
    clearance: tuple[float, float]  # at the leading and the trailing edge, linear along the chord between, m
    damping_ratio: float  # ξ of every mode
    f_omega: float  # rotational frequency, normalised
    revolutions: int
    scheme: str  # of time integration: one of `bladerub.contact.schemes.SCHEMES`
    displacement_limit: float  # a tip displacement beyond this ends the run as unbounded, m
    tolerance: float = 0.01  # largest relative error of wear and peaks of a run that is not chaotic
    steps_per_element: int = 0  # fewest in the passage of an element; 0 leaves it to the tolerance
    max_time_step: float = math.inf  # the step is the largest up to this that divides such a passage, s
    initial_displacement: float = 0.0  # radial, of node 1 at the start, in the first mode and at rest, m

    @property
    def turns(self) -> bool:
        """Whether a profile turns with the tip."""
        return self.tip.turns and not self.coating.is_rigid
