"""What one run is (`RunSpec`) and what it gives (`RunResult`), in SI units unless said to be normalised."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Casing:
    """Inner shape of the rigid casing: nodal diameters of given weight.

    The gap of node j at casing angle φ is ``c_j + (a − δ) − a s(φ)`` with ``s`` the weighted sum of
    ``cos(n φ)`` scaled to a maximum of 1, a the `amplitude` and δ the `interference`.

    Parameters
    ----------
    name : str
        As in the config, for instance ``"2nd"``.
    nodal_diameters : tuple of int
        The n of each term.
    weights : tuple of float
        Weight of each term.
    amplitude : float
        Largest inward displacement a, m.
    interference : float
        Depth δ by which the shape reaches over the blade tip, before the clearance, m.
    start_angle : float
        Casing angle under the stacking line at the start of the run, rad.
    """

    name: str
    nodal_diameters: tuple[int, ...]
    weights: tuple[float, ...]
    amplitude: float
    interference: float
    start_angle: float


@dataclass(frozen=True)
class Coating:
    """Abradable layer: E, K and σ_Y normalised by `modulus_unit`.

    Infinite E and K stand for direct contact with the rigid casing: it does not give way and does not wear.

    Parameters
    ----------
    E, K : float
        Young modulus and plastic (hardening) modulus, normalised; both finite or both infinite.
    theta : float
        Rotation of the abradable elements from the radial direction, rad. The contact force is turned by it
        against the rotation, so it is also the angle of friction: Coulomb's coefficient is ``tan(theta)``.
    yield_stress : float
        Elastic limit σ_Y, normalised.
    modulus_unit : float
        Pa per unit of the normalised moduli.
    thickness : float
        Layer thickness, m.
    n_elements : int
        Bar elements around the circumference, for each interface node.
    law : str
        ``"theta"``: the force has a constant direction. ``"coulomb"``: its tangential part opposes the
        sliding of each node over the casing (`bladerub.contact.friction`).
    """

    E: float
    K: float
    theta: float
    yield_stress: float
    modulus_unit: float
    thickness: float
    n_elements: int
    law: str = "theta"

    @property
    def is_rigid(self) -> bool:
        """Whether this is direct contact with the rigid casing."""
        return math.isinf(self.E) and math.isinf(self.K)

    @property
    def reverses(self) -> bool:
        """Whether the tangential force follows the sliding."""
        return self.law == "coulomb"


@dataclass(frozen=True)
class TipProfile:
    """Circumferential profile of the blade tip under one interface node (Fig. 3): a parabola.

    Parameters
    ----------
    half_width : float
        Tangential half width, in element widths.
    edge_drop : float
        How much lower the edge is than the middle, m.
    """

    half_width: float
    edge_drop: float

    @property
    def curvature(self) -> float:
        """Drop at a distance of one element, m."""
        return self.edge_drop * (1.0 / self.half_width) ** 2


@dataclass(frozen=True)
class RunSpec:
    """One simulation: one coating at one speed.

    Parameters
    ----------
    casing, coating, tip
        The stator, its layer and the profile of the blade tip.
    clearance : tuple of float
        Running clearance at the leading and at the trailing edge, linear along the chord between, m.
    damping_ratio : float
        Modal damping ξ of every mode.
    f_omega : float
        Normalised rotational frequency.
    revolutions : int
        Length of the run.
    scheme : str
        Time integration: one of `bladerub.contact.schemes.SCHEMES`.
    steps_per_element : int
        At least so many time steps in the passage of one coating element.
    max_time_step : float
        The time step is the largest one not above this that divides the passage of one element, s.
    displacement_limit : float
        A tip displacement beyond this ends the run as unbounded, m.
    initial_displacement : float
        Radial displacement of node 1 at the start, in the first mode and at rest, m.
    """

    casing: Casing
    coating: Coating
    tip: TipProfile
    clearance: tuple[float, float]
    damping_ratio: float
    f_omega: float
    revolutions: int
    scheme: str
    steps_per_element: int
    max_time_step: float
    displacement_limit: float
    initial_displacement: float = 0.0


@dataclass(frozen=True)
class SweepSpec:
    """One passage through the speeds.

    Parameters
    ----------
    run : RunSpec
        The run, at the speed where the passage begins; it stays there for its ``revolutions``, if any.
    f_end : float
        Speed where it ends, normalised; above or below the first.
    rate : float
        Change of the normalised speed in a second, positive, 1/s.
    speed_step : float
        Largest change of speed between two stretches of constant speed, normalised.
    """

    run: RunSpec
    f_end: float
    rate: float
    speed_step: float


@dataclass(frozen=True)
class Energy:
    """Energy ledger of the run, J.

    The blade: ``kinetic + elastic − initial + damping = work_radial + work_tangential``. Blade and casing:
    ``kinetic + elastic − initial + damping + stored + wear + sliding = work_shape + work_rotation``.

    Parameters
    ----------
    initial : float
        In the blade at the start.
    kinetic, elastic : float
        In the blade at the end of the run.
    damping : float
        Dissipated by modal damping.
    work_radial, work_tangential : float
        Done on the blade by the radial and by the tangential contact forces.
    stored : float
        Elastic energy in the coating at the end of the run.
    wear : float
        Dissipated by plastic shortening of the coating.
    work_shape : float
        Done by the rotation in moving the tip over the casing, against its shape and onto new bars.
    work_rotation : float
        Done by the rotation against the tangential force of the coating (θ) or friction.
    sliding : float
        Dissipated between tip and casing by that tangential resistance.
    exchanged : float
        Work exchanged in the contact: on the blade and of the casing shape, of each node in each step,
        whatever its sign.
    """

    initial: float
    kinetic: float
    elastic: float
    damping: float
    work_radial: float
    work_tangential: float
    stored: float
    wear: float
    work_shape: float
    work_rotation: float
    sliding: float
    exchanged: float

    @property
    def residual(self) -> float:
        """What the ledger of blade and casing together misses, over the work exchanged; 0 without contact."""
        supplied = self.work_shape + self.work_rotation
        taken = (
            self.kinetic + self.elastic - self.initial + self.damping + self.stored + self.wear + self.sliding
        )
        return abs(supplied - taken) / self.exchanged if self.exchanged else 0.0


@dataclass(frozen=True)
class RunResult:
    """Outcome of one run.

    Parameters
    ----------
    status : str
        ``"completed"``, or ``"unbounded"`` when the tip left all bounds.
    message : str
        The same in words.
    angle : (n_elements,) ndarray
        Casing angle of the element centres, rad.
    wear : (8, n_elements) ndarray
        Permanent shortening of each element under each node, m.
    radial_displacement : (revolutions * n_elements,) ndarray
        Radial displacement of node 1, mean over the passage of each element, m; NaN after an
        unbounded end.
    revolution_peak : (revolutions,) ndarray
        Largest absolute radial displacement of node 1 in each revolution, m; NaN likewise. Between the ends
        of a leap (`bladerub.contact.kernel.free_flight`) it is that of a parabola.
    revolution_amplitude : (revolutions,) ndarray
        Half the range of the radial displacement of node 1 in each revolution, m: its vibration without
        the mean deflection; NaN likewise.
    time_step : float
        Step used, s.
    n_steps, n_contact_steps : int
        Steps made, and those of them with contact.
    n_reversed_steps : int
        Steps with contact in which a node that touches did not slide over the casing with the rotation: it
        slid back or, by Coulomb's law, stuck. Without any, both laws of friction give the same run.
    slowest_sliding : float
        Lowest speed over the casing of a node that touches, over that by the rotation: below 0 it slid back.
        At most 1, which is also that of a run without contact.
    n_modes : int
        Modes that the scheme resolved; the others were condensed.
    energy : Energy
        The ledger.
    """

    status: str
    message: str
    angle: np.ndarray
    wear: np.ndarray
    radial_displacement: np.ndarray
    revolution_peak: np.ndarray
    revolution_amplitude: np.ndarray
    time_step: float
    n_steps: int
    n_contact_steps: int
    n_reversed_steps: int
    slowest_sliding: float
    n_modes: int
    energy: Energy
