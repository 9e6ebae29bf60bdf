"""Contact law of one node with the bars of the coating under it."""

from __future__ import annotations

import numpy as np
from numba import njit

from bladerub.contact.coating import return_mapping
from bladerub.contact.tip import covered, drop

FAST = {"reassoc", "contract", "arcp", "nsz"}  # sums may be reordered; NaN and infinity stay what they are
SETTLED = 1e-12
"""Error of a node's height at which its force is taken as found, m."""
ATTEMPTS = 40
LEVEL = 1e-12
"""Change of penetration below which the force of a bar is taken as constant over a step, m."""


@njit(inline="always")
def wrap(index, n_elements):
    """Bring an index or position less than one turn outside into [0, N)."""
    if index >= n_elements:
        return index - n_elements
    if index < 0:
        return index + n_elements
    return index


@njit(fastmath=FAST)
def _resistance(stator, tip, wear, j, position, rise):
    """Force (N) and stiffness (N/m) of the bars under node `j` at the height `rise`, by eq. of Fig. 4."""
    push = 0.0
    stiffness = 0.0
    elastic, hardening = stator.elastic[j], stator.hardening[j]
    plastic = elastic * hardening / (elastic + hardening)
    first = int(np.ceil(position - tip.half_width)) - 1
    last = int(np.floor(position + tip.half_width))
    for i in range(first, last + 1):
        offset = i + 0.5 - position
        element = wrap(i, wear.shape[1])
        worn = wear[j, element]
        penetration = rise - drop(offset, tip.half_width, tip.edge_drop) - stator.gap[j, element]
        force, worn_now = return_mapping(penetration, worn, elastic, hardening, stator.strength[j])
        if force > 0.0:
            share = covered(offset, tip.half_width)
            push += share * force
            stiffness += share * (plastic if worn_now > worn else elastic)
    return push, stiffness


@njit(fastmath=FAST)
def push_of(stator, tip, wear, j, position, free_rise, own, guess):
    """Push of the coating on node `j`, which gives way by `own` per unit of it, N.

    Solves ``rise + own P(rise) = free_rise`` by Newton's method within a bracket: P is piecewise linear, so
    it ends in a few steps.
    """
    low, high = -np.inf, np.inf
    rise = free_rise - own * guess
    for _ in range(ATTEMPTS):
        push, stiffness = _resistance(stator, tip, wear, j, position, rise)
        error = rise + own * push - free_rise
        if abs(error) <= SETTLED:
            break
        if error > 0.0:
            high = rise
        else:
            low = rise
        rise -= error / (1.0 + own * stiffness)
        if not low < rise < high:  # or it would go round between two pieces
            rise = 0.5 * (low + high)
    return push


@njit(fastmath=FAST)
def settle(stator, tip, wear, j, position, rise, position_before, rise_before):
    """Leave the bars under node `j` as the tip presses them at the end of a step, and account for it.

    An element partly under the tip counts as bars of which a share is under it: as the edge of the profile
    moves on, whole bars are pressed down or let go, at the cost or to the profit of the rotation. Between the
    ends of the step, height and profile go straight from one to the other, and the law of the bars is
    integrated exactly along that way.

    Parameters
    ----------
    position, rise : float
        Of the node at the end of the step: elements, within N of those before, and m.
    position_before, rise_before : float
        The same at its start.

    Returns
    -------
    stored : float
        Elastic energy in the bars, J.
    loss : float
        Energy taken by wear in this step, J.
    supplied : float
        Work of the rotation on the bars in this step, J.
    """
    stored = 0.0
    loss = 0.0
    supplied = 0.0
    elastic, hardening, strength = stator.elastic[j], stator.hardening[j], stator.strength[j]
    first = int(np.ceil(min(position, position_before) - tip.half_width)) - 1
    last = int(np.floor(max(position, position_before) + tip.half_width))
    for i in range(first, last + 1):
        element = wrap(i, wear.shape[1])
        offset, offset_before = i + 0.5 - position, i + 0.5 - position_before
        share = covered(offset, tip.half_width)
        share_before = covered(offset_before, tip.half_width)
        worn, gap = wear[j, element], stator.gap[j, element]
        drop_now = drop(offset, tip.half_width, tip.edge_drop)
        drop_before = drop(offset_before, tip.half_width, tip.edge_drop)
        penetration = rise - drop_now - gap
        penetration_before = rise_before - drop_before - gap
        energy_before = 0.5 * elastic * max(0.0, penetration_before - worn) ** 2
        if share == 0.0:
            supplied -= share_before * energy_before
            continue
        force, worn_now = return_mapping(penetration, worn, elastic, hardening, strength)
        wear[j, element] = worn_now
        energy = 0.5 * force * force / elastic
        taken = (strength + 0.5 * hardening * (worn + worn_now)) * (worn_now - worn)
        stored += share * energy
        loss += taken
        if share_before == 0.0:
            supplied += share * energy + taken
            continue
        mean_share = 0.5 * (share + share_before)
        deeper = penetration - penetration_before
        mean_force = (energy - energy_before + taken) / deeper if abs(deeper) > LEVEL else force
        supplied += mean_share * mean_force * (drop_before - drop_now)
        supplied += 0.5 * (energy + energy_before) * (share - share_before)
        supplied += (1.0 - mean_share) * taken
    return stored, loss, supplied
