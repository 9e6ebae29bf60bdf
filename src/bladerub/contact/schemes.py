"""Time integration: the coefficients of two schemes behind one contract.

What a scheme promises, and `bladerub.contact.kernel.loop.Simulation.advance` carries out:

1. Eq. (1) is solved in the modal coordinates q of the reduced blade at one speed, at a constant step h. Each
   resolved mode follows a two-step recurrence, ``q⁺ = now q − before q⁻``, plus ``gain tip · F`` from the
   contact forces F of one step.
2. *When* that is: a scheme that `corrects` evaluates F at the predicted position of the new step and adds
   ``gain tip · F`` there (prediction and correction, the paper's scheme). One that does not evaluates F at
   the position itself and adds ``gain tip · F`` to the step after.
3. Contact is judged at ``tip · q + compliance · F``, implicitly in F: where the tip moves in the step of the
   force itself, forces and displacement agree with the law of contact. The matrix is symmetric and
   positive semidefinite.
4. A scheme chooses which modes it resolves. The others respond to a force by their static
   displacement, which is part of the compliance.
5. Blade energy ``Σ kinetic (q⁺ − q)² + ½ ω² q⁺ q + ½ F⁺ · C F``, C the compliance of modes not resolved,
   changes by the work ``F · (u⁺ − u⁻) / 2`` less the damping ``Σ loss (q⁺ − q⁻)²``, to rounding where a
   scheme does not correct: the ledger of a run judges contact and step, not the bookkeeping of the blade.
   Where it does, F moved the tip a step before, and the ledger misses the artificial damping, too.

`exponential` is of second order in h and exact for free motion. `central_differences` is of first order, has
a highest mode to resolve, and damps contact artificially.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bladerub.contact.modes import Modes

FASTEST_PHASE = 2.0  # largest ω h the exponential scheme resolves: three steps a period draw no vibration
STEADY = 0.25  # largest κ that the exponential scheme admits in lasting contact; it is stable below 1

ILL_CONDITIONED = 1e9


class Recurrence(NamedTuple):
    """Coefficients of a scheme that resolves n modes; what is 2 j is 3 j with a further motion."""

    now: np.ndarray  # (n,): Coefficients of the present and of the previous modal coordinate
    before: np.ndarray
    gain: np.ndarray  # (n,): Modal coordinate per unit of modal force, s²
    corrects: bool  # Whether the force acts in the step it is evaluated in (contract, 2)
    kinetic: np.ndarray  # (n,): Kinetic energy per ``(q⁺ − q)²``, 1/s²
    loss: np.ndarray  # (n,): Energy lost to damping per ``(q⁺ − q⁻)²``, 1/s²
    tip: np.ndarray  # (2 j, n): Displacement of the tip per unit of each resolved mode, kg^-1/2
    omega: np.ndarray  # (n,): Natural angular frequencies of the resolved modes, rad/s
    share: np.ndarray  # (all modes,): Resolved part of each; the rest responds by its static displacement
    compliance: np.ndarray  # (2 j, 2 j): Of the tip in the step of a force (contract, 3), m/N
    static_compliance: np.ndarray  # (2 j, 2 j): Of the modes that are not resolved alone, m/N
    time_step: float  # h, s
    n_nodes: int  # j, interface nodes


class Contact(NamedTuple):
    """What a scheme needs to know of the contact."""

    stiffness: np.ndarray  # (j,): Largest under each node, N/m, or infinite; (2 j,) with a further motion
    radial: float  # Direction of the force on the blade
    tangential: float


def central_differences(modes: Modes, damping_ratio: float, time_step: float, contact: Contact) -> Recurrence:
    """Set up explicit central differences with prediction and correction, the paper's scheme.

    All modes are resolved. The forces of the coating are those of the predicted position. Those of the rigid
    casing are Lagrange multipliers that put the corrected position on the surface (Carpenter, Taylor and
    Katona 1991). Raises `ValueError` if it is unstable for the highest mode (``ω h ≥ 2``).
    """
    x = modes.omega * time_step
    if x[-1] >= 2.0:
        limit = 2.0 / modes.omega[-1]
        raise ValueError(
            f"time step {time_step:.3g} s: central differences need less than {limit:.3g} s "
            f"for the highest mode of this blade ({modes.omega[-1] / (2 * np.pi):.3g} Hz)"
        )
    implicit = 1.0 + damping_ratio * x
    gain = time_step**2 / implicit
    compliance = (modes.tip * gain) @ modes.tip.T
    none = np.zeros_like(compliance)
    return _recurrence(
        modes,
        now=(2.0 - x**2) / implicit,
        before=(1.0 - damping_ratio * x) / implicit,
        gain=gain,
        corrects=True,
        share=np.ones_like(x),
        compliance=compliance if np.isinf(contact.stiffness).any() else none,
        static_compliance=none,
        time_step=time_step,
    )


def exponential(modes: Modes, damping_ratio: float, time_step: float, contact: Contact) -> Recurrence:
    """Set up the exact recurrence of eq. (1) by modes, the force held over two steps, fast modes condensed.

    A Gautschi-type exponential integrator (Hochbruck and Lubich 1999, eq. 5; Hairer, Lubich and Wanner 2006,
    section XIII.1) for the modes with ``ω h`` up to `FASTEST_PHASE`. The others are condensed to their static
    compliance inside the law of contact, which so is implicit where the blade is stiffest and lightest: the
    same remedy as a redistributed mass (Khenous, Laborde and Renard 2008), found in the modes. Contact stays
    stable however stiff: more modes are condensed until κ, the largest eigenvalue of
    ``Σ φ tan²(ω h/2)/ω² φᵀ`` over the resolved modes times the stiffness of coating and condensed modes in
    series, is at most `STEADY`. (The modes in contact are stable as long as ``gain k < 1 + now + before``.)
    Raises `ValueError` if even the lowest mode alone is too light for the contact at this step.
    """
    x = modes.omega * time_step
    decay = np.exp(-damping_ratio * x)
    phase = x * np.sqrt(1.0 - damping_ratio**2)
    # 1 − now + before without cancellation; over ω² it is the displacement two steps after a unit load
    lag = np.expm1(-damping_ratio * x) ** 2 + 4.0 * decay * np.sin(phase / 2) ** 2
    moving = modes.omega > 0
    gain = np.where(moving, lag / np.where(moving, modes.omega, 1.0) ** 2, time_step**2)
    now, before = 2.0 * decay * np.cos(phase), decay**2
    n = int(np.searchsorted(x, FASTEST_PHASE, side="right"))
    margin = gain[:n] / (1.0 + now[:n] + before[:n])
    while n > 0:
        resolved, share, static = _resolve(modes, x, n, contact)
        if _kappa(resolved, margin[:n], static, contact) <= STEADY:
            break
        n -= 1
    if n == 0:
        raise ValueError(f"time step {time_step:.3g} s: too long for the vibration of this blade in contact")
    return _recurrence(
        resolved,
        now=now[:n],
        before=before[:n],
        gain=gain[:n],
        corrects=False,
        share=share,
        compliance=static,
        static_compliance=static,
        time_step=time_step,
    )


SCHEMES: dict[str, Callable[[Modes, float, float, Contact], Recurrence]] = {
    "exponential": exponential,
    "central_differences": central_differences,
}
"""The schemes by the name that a config gives them."""


def normal_compliance(compliance: np.ndarray, n: int, radial: float, tangential: float) -> np.ndarray:
    """Retreat (n, n) of each of `n` nodes from the casing per unit of contact force at each, m/N.

    That of a further motion and by its forces follows (2 n, 2 n).
    """
    r, t, further = slice(n), slice(n, 2 * n), slice(2 * n, None)
    by_force = compliance[:, r] * radial + compliance[:, t] * tangential
    retreat = -np.hstack([by_force, compliance[:, further] * radial])
    return np.vstack([retreat[r], retreat[further]])


def _resolve(modes: Modes, x: np.ndarray, n: int, contact: Contact) -> tuple[Modes, np.ndarray, np.ndarray]:
    """Part of the first `n` modes that is resolved, its share of each mode, and the compliance of the rest.

    Against the rigid casing a sharp cut leaves one vibration of the tip in contact above all resolved modes,
    which nothing damps: the force chatters after an impact and never stops. There the share decreases
    gradually, ``(1 − (x / x_n)²)²``, and the impact propagates.
    """
    share = np.zeros(x.size)
    share[:n] = 1.0
    if np.isinf(contact.stiffness).all():
        last = FASTEST_PHASE if n == x.size else min(FASTEST_PHASE, x[n])
        share[:n] = (1.0 - (x[:n] / last) ** 2) ** 2
    condensed = share < 1.0
    tip, omega = modes.tip[:, condensed], modes.omega[condensed]
    static = (tip * (1.0 - share[condensed]) / omega**2) @ tip.T
    return Modes(modes.omega[:n], modes.tip[:, :n] * np.sqrt(share[:n]), modes.n_nodes), share, static


def _kappa(modes: Modes, margin: np.ndarray, static: np.ndarray, contact: Contact) -> float:
    _, tip, n_nodes = modes
    direction = n_nodes, contact.radial, contact.tangential
    step = normal_compliance((tip * margin) @ tip.T, *direction)
    series = normal_compliance(static, *direction) + np.diag(1.0 / contact.stiffness)
    moves = np.diag(step) != 0
    if not moves.any():
        return 0.0
    step, series = step[np.ix_(moves, moves)], series[np.ix_(moves, moves)]
    if np.linalg.cond(series) > ILL_CONDITIONED:  # neither the casing nor the tip is compliant
        return np.inf
    return float(np.max(np.abs(np.linalg.eigvals(np.linalg.solve(series, step)))))


def _recurrence(modes: Modes, now, before, gain, **fields) -> Recurrence:
    return Recurrence(
        now=now,
        before=before,
        gain=gain,
        kinetic=(1.0 + before) / (4.0 * gain),
        loss=(1.0 - before) / (4.0 * gain),
        tip=modes.tip,
        omega=modes.omega,
        n_nodes=modes.n_nodes,
        **fields,
    )
