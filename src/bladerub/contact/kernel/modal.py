"""Modal coordinates from step to step, eight in a vector, and the displacement of the tip that they make."""

from typing import NamedTuple

import numpy as np

from bladerub.contact.kernel.records import by_lane
from bladerub.contact.schemes import Recurrence
from bladerub.numerics.lanes import COORDINATES
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import (
    WIDTH,
    add_products,
    address_of,
    aligned,
    broadcast_each,
    load,
    load_fields,
    no_sums,
    read,
    store,
    store_fields,
    sum_of_products,
)
from bladerub.numerics.vectors import LANES, broadcast, lane_sums

FURTHER, APPROACH = 2 * LANES, 3 * LANES
"""Where the further coordinates, or the forces along them, begin in a row of `State`, and the approaches."""


class Modal(NamedTuple):
    """A `Recurrence` as the loop reads it: modes in whole vectors, 24 rows for 16 with a further motion."""

    n: int  # Number of modes, a multiple of 8
    now: np.ndarray  # (n,): Coefficients of the recurrence
    before: np.ndarray
    loss: np.ndarray
    tip: np.ndarray  # (n / 8, 16, 8): Displacement of the tip per unit of each mode, by vectors of modes
    gain: np.ndarray  # (n,): Modal coordinates per unit of modal force
    compliance: np.ndarray  # (16, 16): Displacement of the tip in the step of each force itself, m/N
    corrects: bool  # Whether forces act in the step they are evaluated in
    mobility: np.ndarray  # (16, 16): In a step, by resolved modes alone, as `contact.friction` counts, m/N
    stopping: np.ndarray  # (8,): Most that friction of 1 N on all nodes takes from the sliding of each, m


def pack(rule: Recurrence) -> Modal:
    """Arrange the coefficients of a scheme for the time loop."""
    n = rule.n_nodes
    mobility = (1.0 if rule.corrects else 0.5) * (rule.tip * rule.gain) @ rule.tip.T
    modal = Modal(
        n=rule.now.size + -rule.now.size % LANES,
        now=_padded(rule.now),
        before=_padded(rule.before),
        loss=_padded(rule.loss),
        tip=in_vectors(by_lane(rule.tip, n)),
        gain=_padded(rule.gain),
        compliance=_by_lane_both(rule.compliance, n),
        corrects=rule.corrects,
        mobility=_by_lane_both(mobility, n),
        stopping=by_lane(np.abs(mobility[n : 2 * n, n : 2 * n]).sum(axis=1), n),
    )
    return aligned(modal)


def _by_lane_both(matrix: np.ndarray, n_nodes: int) -> np.ndarray:
    return by_lane(by_lane(matrix, n_nodes).T, n_nodes).T


def _padded(rows: np.ndarray) -> np.ndarray:
    return np.pad(rows, [*[(0, 0)] * (rows.ndim - 1), (0, -rows.shape[-1] % LANES)])


def in_vectors(rows: np.ndarray) -> np.ndarray:
    """Arrange rows (r, n) of modes in blocks (n / 8, r, 8), one for each vector of modes."""
    return _padded(rows).reshape(len(rows), -1, LANES).swapaxes(0, 1)


_NAMES = ("radial", "tangential", "further")[:COORDINATES]
Displacement = NamedTuple("Displacement", [(name, np.ndarray) for name in _NAMES])
"""Of the nodes of the tip, a vector each, m; with a further motion its coordinates, too."""


@inlined
def advance_free(modal, q, q1, q2):
    """Move the modes freely by one step, eq. (1), in place of the oldest coordinates `q2`.

    Returns the displacement of the tip, and the damping loss of the step before, spread over the lanes (J):
    its end is known only now.
    """
    loss, sums = broadcast(0.0), no_sums()
    for k in range(0, modal.n, LANES):
        x, modal_loss = _recur(modal, k, q, q1, q2)
        loss = loss + modal_loss
        store(q2, k, x)
        sums = add_tip_displacement(modal, k, x, sums)
    return tip_displacement(sums), loss


@inlined
def advance_forced(modal, force, q, q1, q2):
    """Move the modes as `advance_free`, under the contact forces (24,) of the step before."""
    loss, forces = broadcast(0.0), broadcast_each(force)
    for k in range(0, modal.n, LANES):
        x, modal_loss = _recur(modal, k, q, q1, q2)
        loss = loss + modal_loss
        store(q2, k, x + load(modal.gain, k) * modal_force(modal, k, forces))
    return _project(modal, q2), loss


@inlined
def correct(modal, force, q):
    """Add the effect of contact forces (24,) to the modal coordinates; return the displacement of the tip."""
    forces = broadcast_each(force)
    for k in range(0, modal.n, LANES):
        store(q, k, load(q, k) + load(modal.gain, k) * modal_force(modal, k, forces))
    return _project(modal, q)


@inlined
def _recur(modal, k, q, q1, q2):
    """Solve eq. (1) without forces for the modes from mode k on: the recurrence of the scheme."""
    present = load(q, k)
    change = present - load(q2, k)
    x = load(modal.now, k) * present - load(modal.before, k) * load(q1, k)
    return x, load(modal.loss, k) * change * change


@inlined
def _project(modal, q):
    sums = no_sums()
    for k in range(0, modal.n, LANES):
        sums = add_tip_displacement(modal, k, load(q, k), sums)
    return tip_displacement(sums)


@inlined
def modal_force(modal, k, forces):
    """Force on the modes from mode k on, by contact forces in all lanes of a vector each."""
    return sum_of_products(address_of(modal.tip, WIDTH * k), forces)


@inlined
def add_tip_displacement(modal, k, x, sums):
    """Add what the modes `x`, from mode k on, displace at the tip, to a sum for each coordinate of it."""
    return add_products(sums, address_of(modal.tip, WIDTH * k), x)


@inlined
def tip_displacement(sums):
    """Displacement of the tip from the sums: the interface rows of eq. (6)."""
    return lane_sums(Displacement, sums)


@inlined
def store_tip(u, displacement, approach):
    """Store a displacement of the tip and the approach of its nodes to the casing (m) in `u` (32,)."""
    store_fields(displacement, u)
    store(u, APPROACH, approach)


@inlined
def load_tip(u):
    """Load a displacement of the tip that was stored."""
    return load_fields(Displacement, u)


@inlined
def displaced(response, force, free):
    """Add to the displacement `free` what contact forces (24,) cause, a row of `response` for each."""
    even, odd = free, tip_displacement(no_sums())  # two sums at the same time
    for i in range(0, WIDTH, 2):
        even = add_products(even, address_of(response, WIDTH * i), broadcast(read(force, i)))
        odd = add_products(odd, address_of(response, WIDTH * (i + 1)), broadcast(read(force, i + 1)))
    return even + odd
