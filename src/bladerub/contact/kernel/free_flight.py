"""Free flight over many time steps at once: what the recurrence of a scheme gives there, in one stride.

A leap is taken only where nothing that the modes can reach in it closes the gap. It leaves the state that its
steps would leave, but for rounding.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.contact.kernel.modal import displacement, in_vectors, no_projection, project
from bladerub.contact.kernel.vectors import LANES, absolute, aligned, broadcast, lane_sum, load, store
from bladerub.contact.schemes import Recurrence

LONGEST = 24
"""Most time steps of a leap: longer ones reach further, and so fit between two contacts less often."""
N_FORMS = 12


class Leap(NamedTuple):
    """Coefficients of `n_steps` free steps of modes that are at q and have moved by d in the last step.

    Parameters
    ----------
    n_steps : int
        Time steps of a leap.
    forms : (n / 8, 12, 8) ndarray
        For each vector of modes: way per unit of q and of d; last step of the leap per unit of q and of d;
        damping loss per unit of q², q d and d², and of the step before the leap; mean way of node 1 per unit
        of q and of d; most that any node rises on the way per unit of ``|q|`` and of ``|d|``.
    sideways : float
        Most that any node moves along the casing while the bound of its rise is 1.
    """

    n_steps: int
    forms: np.ndarray
    sideways: float


def leap_of(rule: Recurrence, n_steps: int, slope: float) -> Leap:
    """Find what `n_steps` free steps of a scheme add up to.

    Parameters
    ----------
    rule : Recurrence
        The scheme.
    n_steps : int
        Time steps of a leap.
    slope : float
        Most that a node rises per unit of its displacement along the casing.
    """
    # Per unit of q (row 0) and of d (row 1), after each step: the way so far, and the step itself
    steps, ways = np.zeros((2, n_steps + 1, 2, rule.now.size))
    steps[0, 1] = 1.0
    for i in range(n_steps):
        steps[i + 1] = (rule.now - rule.before - 1.0) * ways[i] + rule.before * steps[i]
        steps[i + 1, 0] += rule.now - rule.before - 1.0
        ways[i + 1] = ways[i] + steps[i + 1]
    by_q, by_d = (steps[1:] + steps[:-1]).swapaxes(0, 1)
    mean = (ways[1:-1].sum(axis=0) + 0.5 * ways[-1]) / n_steps
    radial, tangential = np.abs(rule.tip[:8]).max(axis=0), np.abs(rule.tip[8:]).max(axis=0)
    rise = radial + slope * tangential
    furthest = np.abs(ways).max(axis=0) * rise
    forms = [
        *ways[-1],
        *steps[-1],
        rule.loss * np.sum(by_q**2, axis=0),
        rule.loss * np.sum(2.0 * by_q * by_d, axis=0),
        rule.loss * np.sum(by_d**2, axis=0),
        rule.loss,
        *mean * rule.tip[0],
        *furthest,
    ]
    moving = tangential > 0
    with np.errstate(divide="ignore"):
        sideways = np.max(tangential[moving] / rise[moving], initial=0.0)
    return aligned(Leap(n_steps, in_vectors(np.array(forms)), float(sideways)))


@njit(forceinline=True)
def reach(leap, n, q, q_before):
    """Bound of what any node can rise in a leap from here, m."""
    forms = leap.forms
    far = broadcast(0.0)
    for k in range(0, n, LANES):
        present = load(q, k)
        far = far + load(forms, N_FORMS * k + 80) * absolute(present)
        far = far + load(forms, N_FORMS * k + 88) * absolute(present - load(q_before, k))
    return lane_sum(far)


@njit(forceinline=True)
def take(leap, motion, q, q1, q2):
    """Move the modes freely by a leap, in place, and project them on the tip.

    Returns
    -------
    radial, tangential : vector
        Displacement of the tip, m.
    loss : vector
        Damping loss up to the end of the leap, J, spread over the lanes. The oldest coordinates `q2` become
        such that `bladerub.contact.kernel.modal.advance` enters none of it again.
    mean : float
        Mean of the way of node 1 over the leap, m.
    far : float
        As `reach`, of the next leap.
    """
    forms = leap.forms
    loss = mean = far = broadcast(0.0)
    sums = no_projection()
    for k in range(0, motion.n, LANES):
        form = N_FORMS * k
        present = load(q, k)
        last, change = present - load(q1, k), present - load(q2, k)
        way = load(forms, form) * present + load(forms, form + 8) * last
        last_step = load(forms, form + 16) * present + load(forms, form + 24) * last
        loss = loss + (load(forms, form + 32) * present + load(forms, form + 40) * last) * present
        loss = loss + load(forms, form + 48) * last * last + load(forms, form + 56) * change * change
        mean = mean + load(forms, form + 64) * present + load(forms, form + 72) * last
        x = present + way
        store(q, k, x)
        store(q1, k, x - last_step)
        store(q2, k, x)
        far = far + load(forms, form + 80) * absolute(x) + load(forms, form + 88) * absolute(last_step)
        sums = project(motion, k, x, sums)
    radial, tangential = displacement(sums)
    return radial, tangential, loss, lane_sum(mean), lane_sum(far)


@njit(forceinline=True)
def extremes(start, end, mean):
    """Lowest and highest value on the way from start to end, of the parabola that has this mean."""
    bottom, top = min(start, end), max(start, end)
    bulge = mean - 0.5 * (start + end)
    if abs(end - start) < 6.0 * abs(bulge):
        vertex = 0.5 * (start + end) + 1.5 * bulge + (end - start) ** 2 / (24.0 * bulge)
        bottom, top = min(bottom, vertex), max(top, vertex)
    return bottom, top
