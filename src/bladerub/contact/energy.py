"""The energy ledger of a run: what the time loop adds up, and the balance that it makes.

Every quadrature is the one that the schemes conserve: the work of the contact forces over a step is the mean
of the forces at its ends times the displacement between, which the loop adds up as ``F (u⁺ − u⁻) / 2``. All
sums so reach to the middle of the last step, and the energies are taken there.

Sliding is not what is left over: the loop adds up the tangential force times the distance that the tip slides
over the casing, and apart from that the moment of the contact forces, which times the angle of a step is the
work of the rotation.
"""

import numpy as np

from bladerub.contact.result import Energy
from bladerub.contact.schemes import Recurrence

RADIAL, TANGENTIAL, DAMPING, SLIDING, SHAPE, TORQUE, EXCHANGED, WEAR = range(8)
"""Sums of the loop: work of the radial and tangential forces on the blade, damping loss, energy taken by
sliding, work of the casing shape, moment of the forces about the axis (N m, one entry a step), work on the
blade and of the shape whatever its sign, energy taken by wear."""
STORED, STORED_BEFORE, LAST_SHAPE, LAST_WEAR = range(8, 12)
"""Of the last step: energy in the coating at its end and start, and what it added to two of the sums."""
REVERSED, FALLBACK, UNCONVERGED, RETREAT = range(12, 16)
"""No energies. Single numbers: steps in which a node in contact did not slide with the rotation, steps whose
forces were found node by node, steps whose forces did not converge. Of each node: how much less than the
rotation it slid at most in a step, in elements."""
COUPLE = 16  # work of the couples on the blade, where the profile of the tip turns
WORN = 17  # no energy: sum of what all elements under each node have worn, m

N_ENTRIES = 18


def blade_energy(rule: Recurrence, state) -> tuple[float, float]:
    """Kinetic and elastic energy of the blade at the middle of the last step (schemes, 5), J."""
    (q, before, _), n = state.q, rule.omega.size
    q, before = q[:n], before[:n]
    kinetic = np.sum(rule.kinetic * (q - before) ** 2)
    force, force_before = forces_of_nodes(state, rule)
    condensed = force @ rule.static_compliance @ force_before
    return float(kinetic), float(0.5 * (np.sum(rule.omega**2 * q * before) + condensed))


def forces_of_nodes(state, rule: Recurrence) -> np.ndarray:
    """Contact forces (2, rows of ``rule.tip``) of a state now and one step before, without unused lanes."""
    groups = state.force.reshape(2, 3, -1)[:, : len(rule.tip) // rule.n_nodes, : rule.n_nodes]
    return groups.reshape(2, -1)


def balance(rule: Recurrence, state, initial: float, angle_per_step: float) -> Energy:
    """Balance the ledger at the middle of the last step.

    `state` is that at the end of the run, `initial` the energy of the blade at its start (J),
    `angle_per_step` the angle by which the blade turns in a step (rad).
    """
    (q, _, oldest), n = state.q, rule.omega.size
    kinetic, elastic = blade_energy(rule, state)
    entry = state.ledger.sum(axis=1)
    damping = entry[DAMPING] + np.sum(rule.loss * (q[:n] - oldest[:n]) ** 2)
    return Energy(
        initial=initial,
        kinetic=kinetic,
        elastic=elastic,
        damping=float(damping),
        work_radial=float(entry[RADIAL]),
        work_tangential=float(entry[TANGENTIAL]),
        work_couple=float(entry[COUPLE]),
        stored=float(0.5 * (entry[STORED] + entry[STORED_BEFORE])),
        wear=float(entry[WEAR] - 0.5 * entry[LAST_WEAR]),
        work_shape=float(entry[SHAPE] - 0.5 * entry[LAST_SHAPE]),
        work_rotation=float(entry[TORQUE] * angle_per_step),
        sliding=float(entry[SLIDING]),
        exchanged=float(entry[EXCHANGED]),
    )
