"""Free flight: the recurrence of a scheme over many time steps at once.

The propagator is used only where no displacement that the modes can reach within it closes the gap. It leaves
the state that its single steps would leave, but for rounding.
"""

from typing import NamedTuple

import numpy as np

from bladerub.contact.kernel.modal import add_tip_displacement, in_vectors, tip_displacement
from bladerub.contact.kernel.records import N_FORMS
from bladerub.contact.schemes import Recurrence
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import aligned, load, no_sums, store
from bladerub.numerics.vectors import LANES, absolute, broadcast, lane_sum

MOST_STEPS = 24  # most time steps at once: more reach further, and so fit between two contacts less often

(
    INCREMENT_Q,
    INCREMENT_D,
    LAST_STEP_Q,
    LAST_STEP_D,
    LOSS_QQ,
    LOSS_QD,
    LOSS_DD,
    LOSS_BEFORE,
    MEAN_Q,
    MEAN_D,
    BOUND_Q,
    BOUND_D,
) = (LANES * row for row in range(N_FORMS))
"""Where the coefficients of a vector of modes begin, per unit of q or of d, or of their products: see
`FreeFlight.forms`."""


class FreeFlight(NamedTuple):
    """Coefficients of `n_steps` free steps of modes that are at q and have moved by d in the last step."""

    n_steps: int  # Time steps at once
    # (n / 8, 12, 8): For each vector of modes: increment of q; last of the steps; damping loss, and that
    # of the step before; mean increment of node 1; bound of the approach of any node to the casing within
    # the steps
    forms: np.ndarray
    sideways: float  # Most that any node moves along the casing while the bound of its approach is 1


def free_flight(rule: Recurrence, n_steps: int, slope: float, edge: float = 0.0) -> FreeFlight:
    """Find what `n_steps` free steps of a scheme add up to.

    `slope` is the most that a node approaches the casing per unit of its displacement along it, `edge` the
    end of the profile, in elements: the most that it does per unit of tilt.
    """
    # Per unit of q (row 0) and of d (row 1), after each step: the increment so far, and the step itself
    steps, increments = np.zeros((2, n_steps + 1, 2, rule.now.size))
    steps[0, 1] = 1.0
    for i in range(n_steps):
        steps[i + 1] = (rule.now - rule.before - 1.0) * increments[i] + rule.before * steps[i]
        steps[i + 1, 0] += rule.now - rule.before - 1.0
        increments[i + 1] = increments[i] + steps[i + 1]
    by_q, by_d = (steps[1:] + steps[:-1]).swapaxes(0, 1)
    mean = (increments[1:-1].sum(axis=0) + 0.5 * increments[-1]) / n_steps
    groups = np.abs(rule.tip).reshape(-1, rule.n_nodes, rule.omega.size).max(axis=1)
    radial, tangential = groups[:2]
    approach = radial + slope * tangential + edge * groups[2:].max(axis=0, initial=0.0)
    bound = np.abs(increments).max(axis=0) * approach
    forms = [
        *increments[-1],
        *steps[-1],
        rule.loss * np.sum(by_q**2, axis=0),
        rule.loss * np.sum(2.0 * by_q * by_d, axis=0),
        rule.loss * np.sum(by_d**2, axis=0),
        rule.loss,
        *mean * rule.tip[0],
        *bound,
    ]
    moving = tangential > 0
    with np.errstate(divide="ignore"):
        sideways = np.max(tangential[moving] / approach[moving], initial=0.0)
    return aligned(FreeFlight(n_steps, in_vectors(np.array(forms)), float(sideways)))


@inlined
def _form(flight, k, row):
    return load(flight.forms, N_FORMS * k + row)


@inlined
def bound(flight, n, q, q_before):
    """Bound of what any node can approach the casing in the next free flight, m."""
    reach = broadcast(0.0)
    for k in range(0, n, LANES):
        present = load(q, k)
        reach = reach + _form(flight, k, BOUND_Q) * absolute(present)
        reach = reach + _form(flight, k, BOUND_D) * absolute(present - load(q_before, k))
    return lane_sum(reach)


@inlined
def fly(flight, modal, q, q1, q2):
    """Move the modes freely by all steps at once, in place, and project them on the tip.

    Returns the displacement of the tip; the damping loss up to the end of the flight, spread over the lanes
    (J), where the oldest coordinates `q2` become such that `modal.advance_free` enters none of it again; the
    mean increment of node 1 (m); and the `bound` of the next flight (m).
    """
    loss = mean = reach = broadcast(0.0)
    sums = no_sums()
    for k in range(0, modal.n, LANES):
        present = load(q, k)
        last, change = present - load(q1, k), present - load(q2, k)
        increment = _form(flight, k, INCREMENT_Q) * present + _form(flight, k, INCREMENT_D) * last
        last_step = _form(flight, k, LAST_STEP_Q) * present + _form(flight, k, LAST_STEP_D) * last
        loss = loss + (_form(flight, k, LOSS_QQ) * present + _form(flight, k, LOSS_QD) * last) * present
        before = _form(flight, k, LOSS_BEFORE) * change * change
        loss = loss + _form(flight, k, LOSS_DD) * last * last + before
        mean = mean + _form(flight, k, MEAN_Q) * present + _form(flight, k, MEAN_D) * last
        x = present + increment
        store(q, k, x)
        store(q1, k, x - last_step)
        store(q2, k, x)
        reach = (
            reach + _form(flight, k, BOUND_Q) * absolute(x) + _form(flight, k, BOUND_D) * absolute(last_step)
        )
        sums = add_tip_displacement(modal, k, x, sums)
    return tip_displacement(sums), loss, lane_sum(mean), lane_sum(reach)


@inlined
def extremes(start, end, mean):
    """Lowest and highest value between start and end, of the parabola that has this mean."""
    bottom, top = min(start, end), max(start, end)
    bulge = mean - 0.5 * (start + end)
    if abs(end - start) < 6.0 * abs(bulge):
        vertex = 0.5 * (start + end) + 1.5 * bulge + (end - start) ** 2 / (24.0 * bulge)
        bottom, top = min(bottom, vertex), max(top, vertex)
    return bottom, top
