"""The modes of the blade from step to step, eight in a vector."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.contact.kernel.vectors import (
    LANES,
    address_of,
    aligned,
    broadcast,
    lane_sums,
    load,
    read,
    store,
)
from bladerub.contact.schemes import Recurrence


class Motion(NamedTuple):
    """A `Recurrence` as the time loop reads it: modes padded with zeros to whole vectors.

    Parameters
    ----------
    n : int
        Number of modes, a multiple of 8.
    now, before, loss : (n,) ndarray
        Coefficients of the recurrence.
    tip : (n / 8, 16, 8) ndarray
        Displacement of the tip per unit of each mode, a block for each vector of modes.
    gain : (n,) ndarray
        Modal coordinates per unit of modal force.
    compliance : (16, 16) ndarray
        Displacement of the tip in the step of each force itself, m/N.
    corrects : bool
        Whether forces act in the step they are evaluated in.
    mobility : (16, 16) ndarray
        Way of the tip in a step, as `bladerub.contact.friction` counts it, per unit of each force of the
        step, by the modes that the scheme resolves, m/N.
    stopping : (8,) ndarray
        The most that tangential forces of 1 N on all nodes take from the way of each, m.
    """

    n: int
    now: np.ndarray
    before: np.ndarray
    loss: np.ndarray
    tip: np.ndarray
    gain: np.ndarray
    compliance: np.ndarray
    corrects: bool
    mobility: np.ndarray
    stopping: np.ndarray


def pack(rule: Recurrence) -> Motion:
    """Arrange the coefficients of a scheme for the time loop."""
    mobility = (1.0 if rule.corrects else 0.5) * (rule.tip * rule.gain) @ rule.tip.T
    motion = Motion(
        n=rule.now.size + -rule.now.size % LANES,
        now=_padded(rule.now),
        before=_padded(rule.before),
        loss=_padded(rule.loss),
        tip=in_vectors(rule.tip),
        gain=_padded(rule.gain),
        compliance=rule.compliance,
        corrects=rule.corrects,
        mobility=mobility,
        stopping=np.abs(mobility[LANES:, LANES:]).sum(axis=1),
    )
    return aligned(motion)


def _padded(rows: np.ndarray) -> np.ndarray:
    missing = -rows.shape[-1] % LANES
    return np.pad(rows, [(0, 0)] * (rows.ndim - 1) + [(0, missing)])


def in_vectors(rows: np.ndarray) -> np.ndarray:
    """Arrange rows (r, n) of modes in blocks (n / 8, r, 8), one for each vector of modes."""
    padded = _padded(rows)
    return padded.reshape(len(rows), -1, LANES).swapaxes(0, 1)


@njit(forceinline=True)
def advance(motion, q, q1, q2):
    """Move the modes freely by one step, in place of the oldest coordinates `q2`; project them on the tip.

    Returns
    -------
    radial, tangential : vector
        Displacement of the tip, the interface rows of eq. (6), m.
    loss : vector
        Damping loss of the step before, J, spread over the lanes: its end is known only now.
    """
    loss = broadcast(0.0)
    sums = no_projection()
    for k in range(0, motion.n, LANES):
        x, more = _step(motion, k, q, q1, q2)
        loss = loss + more
        store(q2, k, x)
        sums = project(motion, k, x, sums)
    radial, tangential = displacement(sums)
    return radial, tangential, loss


@njit(forceinline=True)
def advance_under(motion, force, q, q1, q2):
    """Do as `advance`, with the contact forces of the step before."""
    loss = broadcast(0.0)
    forces = _spread(force)
    for k in range(0, motion.n, LANES):
        x, more = _step(motion, k, q, q1, q2)
        loss = loss + more
        store(q2, k, x + _pushed(motion, k, forces))
    radial, tangential = _projection(motion, q2)
    return radial, tangential, loss


@njit(forceinline=True)
def push_modes(motion, force, q):
    """Add the effect of contact forces to the modal coordinates; project these on the tip, as `advance`."""
    forces = _spread(force)
    for k in range(0, motion.n, LANES):
        store(q, k, load(q, k) + _pushed(motion, k, forces))
    return _projection(motion, q)


@njit(inline="always")
def _step(motion, k, q, q1, q2):
    present = load(q, k)
    change = present - load(q2, k)
    x = load(motion.now, k) * present - load(motion.before, k) * load(q1, k)
    return x, load(motion.loss, k) * change * change


@njit(forceinline=True)
def _projection(motion, q):
    sums = no_projection()
    for k in range(0, motion.n, LANES):
        sums = project(motion, k, load(q, k), sums)
    return displacement(sums)


@njit(inline="always")
def no_projection():
    """Begin the sums that `project` adds to and `displacement` closes."""
    zero = broadcast(0.0)
    return (zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero, zero)


@njit(inline="always")
def project(motion, k, x, sums):
    """Add what the modes `x`, from mode k on, displace at the tip: the interface rows of eq. (6)."""
    rows = address_of(motion.tip, 16 * k)
    return (
        sums[0] + load(rows, 0) * x,
        sums[1] + load(rows, 8) * x,
        sums[2] + load(rows, 16) * x,
        sums[3] + load(rows, 24) * x,
        sums[4] + load(rows, 32) * x,
        sums[5] + load(rows, 40) * x,
        sums[6] + load(rows, 48) * x,
        sums[7] + load(rows, 56) * x,
        sums[8] + load(rows, 64) * x,
        sums[9] + load(rows, 72) * x,
        sums[10] + load(rows, 80) * x,
        sums[11] + load(rows, 88) * x,
        sums[12] + load(rows, 96) * x,
        sums[13] + load(rows, 104) * x,
        sums[14] + load(rows, 112) * x,
        sums[15] + load(rows, 120) * x,
    )


@njit(inline="always")
def displacement(sums):
    """Radial and tangential displacement of the tip, m."""
    r0, r1, r2, r3, r4, r5, r6, r7, t0, t1, t2, t3, t4, t5, t6, t7 = sums
    return lane_sums(r0, r1, r2, r3, r4, r5, r6, r7), lane_sums(t0, t1, t2, t3, t4, t5, t6, t7)


@njit(inline="always")
def _pushed(motion, k, forces):
    rows = address_of(motion.tip, 16 * k)
    x, y = load(rows, 0) * forces[0], load(rows, 8) * forces[1]  # halves of the sum, found at the same time
    x, y = x + load(rows, 16) * forces[2], y + load(rows, 24) * forces[3]
    x, y = x + load(rows, 32) * forces[4], y + load(rows, 40) * forces[5]
    x, y = x + load(rows, 48) * forces[6], y + load(rows, 56) * forces[7]
    x, y = x + load(rows, 64) * forces[8], y + load(rows, 72) * forces[9]
    x, y = x + load(rows, 80) * forces[10], y + load(rows, 88) * forces[11]
    x, y = x + load(rows, 96) * forces[12], y + load(rows, 104) * forces[13]
    x, y = x + load(rows, 112) * forces[14], y + load(rows, 120) * forces[15]
    return load(motion.gain, k) * (x + y)


@njit(inline="always")
def _spread(force):
    return (
        broadcast(read(force, 0)),
        broadcast(read(force, 1)),
        broadcast(read(force, 2)),
        broadcast(read(force, 3)),
        broadcast(read(force, 4)),
        broadcast(read(force, 5)),
        broadcast(read(force, 6)),
        broadcast(read(force, 7)),
        broadcast(read(force, 8)),
        broadcast(read(force, 9)),
        broadcast(read(force, 10)),
        broadcast(read(force, 11)),
        broadcast(read(force, 12)),
        broadcast(read(force, 13)),
        broadcast(read(force, 14)),
        broadcast(read(force, 15)),
    )


@njit(forceinline=True)
def respond(response, force, radial, tangential):
    """Add to the displacement of the tip what the contact forces cause, a row of `response` for each."""
    more_radial, more_tangential = (
        broadcast(0.0),
        broadcast(0.0),
    )  # halves of the sums, found at the same time
    for i in range(0, 16, 2):
        by, by_next = read(force, i), read(force, i + 1)
        radial = radial + load(response, 16 * i) * by
        tangential = tangential + load(response, 16 * i + 8) * by
        more_radial = more_radial + load(response, 16 * i + 16) * by_next
        more_tangential = more_tangential + load(response, 16 * i + 24) * by_next
    return radial + more_radial, tangential + more_tangential
