"""What one run is, in SI units unless said to be normalised."""

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Casing:
    """Inner shape of the rigid casing: waves or bumps of given weight, or as measured.

    The gap of node j at casing angle φ is ``c_j + (a − δ) − a s(φ)`` with the shape ``s``, whose maximum is 1
    (`bladerub.contact.casing.shape`).

    Attributes
    ----------
    name : str
        As in the config, for instance ``"2nd"``.
    nodal_diameters : tuple of int
        n of each term: so many waves, or bumps, around the circumference.
    weights : tuple of float
        Of each term.
    amplitude : float
        Largest inward displacement a, m.
    interference : float
        Depth δ by which the shape reaches over the blade tip, before the clearance, m.
    start_angle : float
        Casing angle under the stacking line at the start of the run, rad.
    bump_width : float
        Of Gaussian bumps instead of waves, over their distance; 0 for waves.
    measured : tuple of (float, float)
        Instead of terms: angles (rad, ascending), and the shape there.
    """

    name: str
    nodal_diameters: tuple[int, ...]
    weights: tuple[float, ...]
    amplitude: float
    interference: float
    start_angle: float
    bump_width: float = 0.0
    measured: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class ElementLaw:
    """Law of the abradable elements.

    Attributes
    ----------
    name : str
        ``"plastic"``, that of the paper, or one that plugs in (`bladerub.contact.laws`).
    parameters : tuple of (str, float)
        Name and value of those beside E, K and σ_Y, SI units.
    source : str
        Text of a module that is not of this package.
    """

    name: str = "plastic"
    parameters: tuple[tuple[str, float], ...] = ()
    source: str = ""

    @property
    def label(self) -> str:
        """Name and values, for instance ``viscoplastic (viscosity 10000)``."""
        values = ", ".join(f"{name} {value:g}" for name, value in self.parameters)
        return f"{self.name} ({values})" if values else self.name


PLASTIC = ElementLaw()
"""One-dimensional plasticity with linear hardening (Fig. 4)."""


@dataclass(frozen=True)
class Coating:
    """Abradable layer: E, K and σ_Y normalised by `modulus_unit`.

    Infinite E and K stand for direct contact with the rigid casing: it neither deforms nor wears.

    Attributes
    ----------
    E, K : float
        Young modulus and plastic (hardening) modulus, normalised; both finite or both infinite.
    theta : float
        Rotation θ of the abradable elements from the radial direction, rad. The contact force is turned by it
        against the rotation, so it is also the angle of friction: Coulomb's coefficient is tan θ.
    yield_stress : float
        Elastic limit σ_Y, normalised.
    modulus_unit : float
        Pa per unit of the normalised moduli.
    thickness : float
        Of the layer, m.
    n_elements : int
        Abradable elements around the circumference, for each interface node.
    law : str
        ``"theta"``: the force has a constant direction; ``"coulomb"``: its tangential part opposes the
        sliding of each node over the casing (`bladerub.contact.friction`).
    element_law : ElementLaw
        Of force and wear along the elements.
    """

    E: float
    K: float
    theta: float
    yield_stress: float
    modulus_unit: float
    thickness: float
    n_elements: int
    law: str = "theta"
    element_law: ElementLaw = PLASTIC

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
    """Circumferential profile of the blade tip under one interface node (Fig. 3): a parabola.

    Attributes
    ----------
    half_width : float
        Tangential, in element widths.
    edge_drop : float
        How much lower the edge is than the middle, m.
    turns : bool
        With the blade tip; direct contact with the rigid casing has no profile.
    """

    half_width: float
    edge_drop: float
    turns: bool = False

    @property
    def curvature(self) -> float:
        """Drop at a distance of one element, m."""
        return self.edge_drop * (1.0 / self.half_width) ** 2


@dataclass(frozen=True)
class RunSpec:
    """One simulation: one coating at one speed.

    Attributes
    ----------
    casing : Casing
    coating : Coating
    tip : TipProfile
    clearance : (float, float)
        At the leading and the trailing edge, linear along the chord between, m.
    damping_ratio : float
        ξ of every mode.
    f_omega : float
        Rotational frequency, normalised.
    revolutions : int
    scheme : str
        Of time integration: one of `bladerub.contact.schemes.SCHEMES`.
    displacement_limit : float
        A tip displacement beyond this ends the run as unbounded, m.
    tolerance : float
        Largest relative error of wear and peaks of a run that is not chaotic: the time step follows from it
        (`bladerub.contact.steps`), unless one of the next two is there.
    steps_per_element : int
        Fewest in the passage of one coating element; 0 leaves it to the tolerance.
    max_time_step : float
        The step is the largest up to this that divides such a passage, s.
    initial_displacement : float
        Radial, of node 1 at the start, in the first mode and at rest, m.
    """

    casing: Casing
    coating: Coating
    tip: TipProfile
    clearance: tuple[float, float]
    damping_ratio: float
    f_omega: float
    revolutions: int
    scheme: str
    displacement_limit: float
    tolerance: float = 0.01
    steps_per_element: int = 0
    max_time_step: float = math.inf
    initial_displacement: float = 0.0

    @property
    def turns(self) -> bool:
        """Whether a profile turns with the tip."""
        return self.tip.turns and not self.coating.is_rigid
