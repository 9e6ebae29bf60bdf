"""Contact law of the tip's nodes with the bars of the coating under them, a lane a node.

Rows of bars: row r has for each node the bar that is r elements past the one it stands over at the start of
a revolution, so that all nodes meet the same few rows at the same time.
"""

from __future__ import annotations

import math

from numba import njit

from bladerub.contact.kernel.vectors import (
    LANES,
    choose,
    higher,
    highest,
    load,
    lower,
    lowest,
    magnitude,
    splat,
    store,
)

LEVEL = 1e-12
"""Change of penetration below which the force of a bar is taken as constant over a step, m."""


@njit(inline="always")
def wrap(index, n_elements):
    """Bring an index less than one turn outside into [0, N)."""
    if index >= n_elements:
        return index - n_elements
    if index < 0:
        return index + n_elements
    return index


@njit(inline="always")
def rows_under(tip, behind, ahead):
    """First and last row that the profile covers of any node between positions `behind` and `ahead`."""
    return math.floor(lowest(behind) - tip.half_width), math.floor(highest(ahead) + tip.half_width)


@njit(inline="always")
def _covered(tip, offset):
    return higher(lower(tip.half_width + 0.5 - magnitude(offset), 1.0), 0.0)


@njit(inline="always")
def _drop(tip, offset):
    return tip.drop * (offset * offset)


@njit(forceinline=True)
def push_at(stator, tip, wear, position, rows, rise):
    """Press the bars under each node to the height `rise`, as in Fig. 4, but leave them as they are.

    Returns
    -------
    push, stiffness : vector
        Force of the bars, N, and what it gains per height, N/m.
    margin : vector
        Change of height over which it is linear, m: no bar comes to bear, yields or is let go.
    """
    elastic, hardening = load(stator.elastic, 0), load(stator.hardening, 0)
    strength = load(stator.strength, 0)
    yielding = elastic * load(stator.yielding, 0)
    plastic = yielding * hardening
    push, stiffness, margin = splat(0.0), splat(0.0), splat(math.inf)
    first, last = rows
    for row in range(first, last + 1):
        at = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share = _covered(tip, offset)
        worn = load(wear, at)
        trial = elastic * (rise - _drop(tip, offset) - load(stator.gap, at) - worn)
        excess = trial - strength - hardening * worn
        push = push + share * higher(trial - yielding * higher(excess, 0.0), 0.0)
        stiffness = stiffness + share * choose(trial > 0.0, choose(excess > 0.0, plastic, elastic), 0.0)
        margin = lower(margin, lower(magnitude(trial), magnitude(excess)))
    return push, stiffness, 2.0 * load(stator.softness, 0) * margin


@njit(forceinline=True)
def settle(stator, tip, wear, position, rise, position_before, rise_before):
    """Leave the bars as the tip presses them at the end of a step, and account for it.

    An element partly under the tip counts as bars of which a share is under it: as the edge of the profile
    moves on, whole bars are pressed down or let go, at the cost or to the profit of the rotation. Between the
    ends of the step, height and profile go straight from one to the other, and the law of the bars is
    integrated exactly along that way.

    Parameters
    ----------
    position, rise : vector
        Of the nodes at the end of the step: rows, less than N from those before, and m.
    position_before, rise_before : vector
        The same at its start.

    Returns
    -------
    stored : vector
        Elastic energy in the bars, J.
    loss : vector
        Energy taken by wear in this step, J.
    supplied : vector
        Work of the rotation on the bars in this step, J.
    """
    elastic, hardening = load(stator.elastic, 0), load(stator.hardening, 0)
    strength = load(stator.strength, 0)
    yielding, softness = load(stator.yielding, 0), load(stator.softness, 0)
    stored, loss, supplied = splat(0.0), splat(0.0), splat(0.0)
    first, last = rows_under(tip, lower(position, position_before), higher(position, position_before))
    way, climb = position - position_before, rise - rise_before
    shift, slope = _drop(tip, way), 2.0 * tip.drop * way
    for row in range(first, last + 1):
        at = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share, share_before = _covered(tip, offset), _covered(tip, offset + way)
        lowering = slope * offset + shift  # of the profile over this bar, in the step
        worn = load(wear, at)
        penetration = rise - _drop(tip, offset) - load(stator.gap, at) - worn
        deeper = climb + lowering
        trial, trial_before = elastic * penetration, elastic * higher(penetration - deeper, 0.0)
        limit = strength + hardening * worn
        under = share > 0.0
        shortening = choose(under, yielding * higher(choose(trial > 0.0, trial - limit, 0.0), 0.0), 0.0)
        store(wear, at, worn + shortening)
        force = choose(under, higher(trial - elastic * shortening, 0.0), 0.0)
        energy, energy_before = softness * (force * force), softness * (trial_before * trial_before)
        taken = (limit + 0.5 * hardening * shortening) * shortening
        stored = stored + share * energy
        loss = loss + taken
        mean_share = 0.5 * (share + share_before)
        moved = magnitude(deeper) > LEVEL
        mean_force = choose(moved, (energy - energy_before + taken) / choose(moved, deeper, 1.0), force)
        staying = (
            mean_share * mean_force * lowering
            + 0.5 * (energy + energy_before) * (share - share_before)
            + (1.0 - mean_share) * taken
        )
        supplied = supplied + choose(
            under,
            choose(share_before > 0.0, staying, share * energy + taken),
            splat(0.0) - share_before * energy_before,
        )
    return stored, loss, supplied
