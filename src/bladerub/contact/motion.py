"""The modes of the blade from step to step, eight in a vector."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.contact.schemes import Recurrence
from bladerub.contact.vectors import LANES, aligned, at, load, read, splat, store, totals


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
    push : (n / 8, 16, 8) ndarray
        Modal coordinates per unit of each tip force, in the same blocks.
    kick : (16, 16) ndarray
        What ``push`` displaces at the tip: a row for each force, m/N.
    compliance : (16, 16) ndarray
        Displacement of the tip in the step of each force itself, m/N.
    corrects : bool
        Whether forces act in the step they are evaluated in.
    """

    n: int
    now: np.ndarray
    before: np.ndarray
    loss: np.ndarray
    tip: np.ndarray
    push: np.ndarray
    kick: np.ndarray
    compliance: np.ndarray
    corrects: bool


def pack(rule: Recurrence) -> Motion:
    """Arrange the coefficients of a scheme for the time loop."""
    motion = Motion(
        n=rule.now.size + -rule.now.size % LANES,
        now=_padded(rule.now),
        before=_padded(rule.before),
        loss=_padded(rule.loss),
        tip=_blocks(rule.tip),
        push=_blocks(rule.push),
        kick=rule.push @ rule.tip.T,
        compliance=rule.compliance,
        corrects=rule.corrects,
    )
    return aligned(motion)


def _padded(rows: np.ndarray) -> np.ndarray:
    missing = -rows.shape[-1] % LANES
    return np.pad(rows, [(0, 0)] * (rows.ndim - 1) + [(0, missing)])


def _blocks(rows: np.ndarray) -> np.ndarray:
    padded = _padded(rows)
    return padded.reshape(len(rows), -1, LANES).swapaxes(0, 1)


@njit
def advance(motion, q, q1, q2):
    """Move the modes freely by one step, in place of the oldest coordinates `q2`; project them on the tip.

    Returns
    -------
    radial, tangential : vector
        Displacement of the tip, the interface rows of eq. (6), m.
    loss : vector
        Damping loss of the step before, J, spread over the lanes: its end is known only now.
    """
    tip = motion.tip
    loss = splat(0.0)
    r0 = r1 = r2 = r3 = r4 = r5 = r6 = r7 = splat(0.0)
    t0 = t1 = t2 = t3 = t4 = t5 = t6 = t7 = splat(0.0)
    for k in range(0, motion.n, LANES):
        present = load(q, k)
        change = present - load(q2, k)
        loss = loss + load(motion.loss, k) * change * change
        x = load(motion.now, k) * present - load(motion.before, k) * load(q1, k)
        store(q2, k, x)
        r0 = r0 + load(tip, 16 * k) * x
        r1 = r1 + load(tip, 16 * k + 8) * x
        r2 = r2 + load(tip, 16 * k + 16) * x
        r3 = r3 + load(tip, 16 * k + 24) * x
        r4 = r4 + load(tip, 16 * k + 32) * x
        r5 = r5 + load(tip, 16 * k + 40) * x
        r6 = r6 + load(tip, 16 * k + 48) * x
        r7 = r7 + load(tip, 16 * k + 56) * x
        t0 = t0 + load(tip, 16 * k + 64) * x
        t1 = t1 + load(tip, 16 * k + 72) * x
        t2 = t2 + load(tip, 16 * k + 80) * x
        t3 = t3 + load(tip, 16 * k + 88) * x
        t4 = t4 + load(tip, 16 * k + 96) * x
        t5 = t5 + load(tip, 16 * k + 104) * x
        t6 = t6 + load(tip, 16 * k + 112) * x
        t7 = t7 + load(tip, 16 * k + 120) * x
    return totals(r0, r1, r2, r3, r4, r5, r6, r7), totals(t0, t1, t2, t3, t4, t5, t6, t7), loss


@njit
def push_modes(motion, force, q):
    """Add the effect of the contact forces to the modal coordinates."""
    push = motion.push
    r0, r1, r2, r3, r4, r5, r6, r7 = _spread(force)
    t0, t1, t2, t3, t4, t5, t6, t7 = _spread(at(force, 8))
    for k in range(0, motion.n, LANES):
        x, y = load(q, k), splat(0.0)  # halves of the sum, found at the same time
        x = x + load(push, 16 * k) * r0
        y = y + load(push, 16 * k + 64) * t0
        x = x + load(push, 16 * k + 8) * r1
        y = y + load(push, 16 * k + 72) * t1
        x = x + load(push, 16 * k + 16) * r2
        y = y + load(push, 16 * k + 80) * t2
        x = x + load(push, 16 * k + 24) * r3
        y = y + load(push, 16 * k + 88) * t3
        x = x + load(push, 16 * k + 32) * r4
        y = y + load(push, 16 * k + 96) * t4
        x = x + load(push, 16 * k + 40) * r5
        y = y + load(push, 16 * k + 104) * t5
        x = x + load(push, 16 * k + 48) * r6
        y = y + load(push, 16 * k + 112) * t6
        x = x + load(push, 16 * k + 56) * r7
        y = y + load(push, 16 * k + 120) * t7
        store(q, k, x + y)


@njit(inline="always")
def _spread(force):
    return (
        splat(read(force, 0)),
        splat(read(force, 1)),
        splat(read(force, 2)),
        splat(read(force, 3)),
        splat(read(force, 4)),
        splat(read(force, 5)),
        splat(read(force, 6)),
        splat(read(force, 7)),
    )


@njit
def respond(response, force, radial, tangential):
    """Add to the displacement of the tip what the contact forces cause, a row of `response` for each."""
    more_radial, more_tangential = splat(0.0), splat(0.0)  # halves of the sums, found at the same time
    for i in range(0, 16, 2):
        by, by_next = read(force, i), read(force, i + 1)
        radial = radial + load(response, 16 * i) * by
        tangential = tangential + load(response, 16 * i + 8) * by
        more_radial = more_radial + load(response, 16 * i + 16) * by_next
        more_tangential = more_tangential + load(response, 16 * i + 24) * by_next
    return radial + more_radial, tangential + more_tangential
