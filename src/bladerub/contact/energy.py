"""The energy ledger of a run: what the time loop adds up, and what becomes of it.

Every quadrature is the one that the schemes conserve: the work of the contact forces over a step is the mean
of the forces at its ends times the displacement between, which the loop adds up as ``F (u⁺ − u⁻) / 2``. All
sums so reach to the middle of the last step, and the energies are taken there.
"""

from __future__ import annotations

import numpy as np

from bladerub.contact.schemes import Recurrence
from bladerub.contact.spec import Energy

RADIAL, TANGENTIAL, DAMPING, NORMAL, SHAPE, TORQUE, EXCHANGED, WEAR = range(8)
"""Sums of the loop: work of the radial and tangential forces on the blade, damping loss, work of the tip on
the coating, work of the casing shape, moment of the forces about the axis (N m, one entry a step), work on
the blade and of the shape whatever its sign, energy taken by wear."""

STORED, STORED_BEFORE, LAST_SHAPE, LAST_WEAR = range(8, 12)
"""Of the last step: energy in the coating at its end and start, and what it added to two of the sums."""

REVERSED, RETREAT = 12, 13
"""No energies: the number of steps in which a node that touches did not slide with the rotation (one number),
and how much less than the rotation such a node slid at most in a step (of each node), elements."""

N_ENTRIES = 14


def blade_energy(rule: Recurrence, state) -> tuple[float, float]:
    """Kinetic and elastic energy of the blade at the middle of the last step (schemes, 5), J."""
    (q, before, _), n = state.q, rule.omega.size
    q, before = q[:n], before[:n]
    kinetic = np.sum(rule.kinetic * (q - before) ** 2)
    condensed = state.force[0] @ rule.static_compliance @ state.force[1]
    return float(kinetic), float(0.5 * (np.sum(rule.omega**2 * q * before) + condensed))


def close(rule: Recurrence, state, initial: float, angle_per_step: float) -> Energy:
    """Close the ledger at the middle of the last step.

    Parameters
    ----------
    rule : Recurrence
        The scheme.
    state : bladerub.contact.kernel.loop.State
        At the end of the run.
    initial : float
        Energy of the blade at the start, J.
    angle_per_step : float
        Angle by which the blade turns in a step, rad.
    """
    (q, _, oldest), n = state.q, rule.omega.size
    kinetic, elastic = blade_energy(rule, state)
    entry = state.ledger.sum(axis=1)
    damping = entry[DAMPING] + np.sum(rule.loss * (q[:n] - oldest[:n]) ** 2)
    shape = entry[SHAPE] - 0.5 * entry[LAST_SHAPE]
    rotation = entry[TORQUE] * angle_per_step
    on_blade = entry[RADIAL] + entry[TANGENTIAL]
    return Energy(
        initial=initial,
        kinetic=kinetic,
        elastic=elastic,
        damping=float(damping),
        work_radial=float(entry[RADIAL]),
        work_tangential=float(entry[TANGENTIAL]),
        stored=float(0.5 * (entry[STORED] + entry[STORED_BEFORE])),
        wear=float(entry[WEAR] - 0.5 * entry[LAST_WEAR]),
        work_shape=float(shape),
        work_rotation=float(rotation),
        sliding=float(rotation - on_blade - entry[NORMAL]),
        exchanged=float(entry[EXCHANGED]),
    )
