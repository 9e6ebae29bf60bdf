"""How many time steps the passage of an element takes: from a tolerance, or as the run says.

The error of a run is of second order in its step h. It has two causes, which add up:

1. *An element under the tip.* Its worn depth is the deepest that the profile of the tip came at the end of
   a step, and the work of a step is the mean force times its displacement. In n steps per element both have
   errors proportional to 1/n², whatever the coating: ``(PASSAGE/n)²``. A law of the elements that depends on
   the rate counts the time that an element is under the tip, which is known to half a step: ``RATE/n``.
2. *The tip that bounces on the coating.* Within a step the tip yields to a force by the compliance of the
   trapezoidal rule, ``C(h) = Σ φ φᵀ / (ω² + 4/h²)``: statically in modes that are fast, as a free mass in
   those that are slow. κ is the largest eigenvalue of ``k C(h)``, k the stiffness of the elements under each
   node. For a mass m on one spring it is ``(h/2)² k/m`` of the bounce, whose period has the relative error
   κ/6: ``κ/BOUNCE``. Where in a step contact begins and ends decides the sign of the error, so those of
   several bounces average out: of b in the passage of an element, ``b = n √κ / π``, by ``√(b/AVERAGED)``. On
   the rigid casing the tip does not vibrate on a spring: the modes that a step resolves meet a constraint.
   There `RIGID` times the steps of the first cause are enough.

The two factors are calibrated on runs of the study (docs/explanation/performance.md). Runs that are chaotic
have no error that a step could bound; the limits are the same for them. Central differences are of first
order and stable below ``ω h = 2``: they take steps of `STABLE_PART` of that at most, and no tolerance holds.
"""

import math
from dataclasses import replace

import numpy as np

from bladerub.contact.modes import Modes
from bladerub.contact.schemes import Contact, normal_compliance
from bladerub.contact.spec import RunSpec

PASSAGE = 0.36  # root of the relative error by the passage of an element in one step
RATE = 0.18  # relative error by the passage of an element in one step, of a law that depends on the rate
BOUNCE = 13.0  # κ at which the bounce makes a relative error of 1, by its small values
AVERAGED = 1.5  # bounces in the passage of an element from which on their errors average out
RIGID = 3  # factor of the steps on the rigid casing
STABLE_PART = 0.7  # longest step of central differences over ``2 / ω_max``: contact stiffens the blade


def own_steps(passage: float, n_steps: int, longest: float) -> int:
    """Return the fewest steps in a `passage` (s), `n_steps` at least and of `longest` (s) at most.

    It is 0 without limits (0 and infinity): the tolerance of the run decides.
    """
    return max(n_steps, math.ceil(passage / longest))


def steps_per_element(
    spec: RunSpec, modes: Modes, contact: Contact, passage: float, depends_on_rate: bool = False
) -> int:
    """Return the fewest steps in the `passage` (s) of an element that the tolerance of the run allows."""
    factor, order = (RATE, 1) if depends_on_rate else (PASSAGE**2, 2)
    n_steps = math.ceil((factor / spec.tolerance) ** (1 / order) - 1e-9)
    if spec.scheme == "central_differences":
        n_steps = max(n_steps, math.ceil(passage * modes.omega[-1] / (2 * STABLE_PART)))
    if np.isinf(contact.stiffness).any():
        return RIGID * n_steps

    def error() -> float:
        kappa = bounce(modes, contact, passage / n_steps)
        bounces = n_steps * math.sqrt(kappa) / math.pi
        return factor / n_steps**order + kappa / BOUNCE * math.sqrt(AVERAGED / max(AVERAGED, bounces))

    while (excess := error() / spec.tolerance) > 1:  # more steps decrease it with their square at most
        n_steps = max(n_steps + 1, math.floor(n_steps * math.sqrt(excess)))
    return n_steps


def bounce(modes: Modes, contact: Contact, time_step: float) -> float:
    """Return κ, the compliance of the tip within a step over that of the coating: see above."""
    compliance = (modes.tip / (modes.omega**2 + (2 / time_step) ** 2)) @ modes.tip.T
    compliance = normal_compliance(compliance, modes.n_nodes, contact.radial, contact.tangential)
    return float(np.abs(np.linalg.eigvals(contact.stiffness[:, None] * compliance)).max())


def with_steps(spec: RunSpec, n_steps: int) -> RunSpec:
    """Return the run with so many steps in the passage of an element."""
    return replace(spec, steps_per_element=n_steps, max_time_step=math.inf)
