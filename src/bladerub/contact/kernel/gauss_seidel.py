"""Contact forces node by node until none changes any more: slow, and sure to get there.

For the rigid casing, and for the few steps of stiff coatings that Newton's method of the time loop cannot
settle.
"""

from __future__ import annotations

import math

import numpy as np
from numba import njit

from bladerub.contact import friction, law
from bladerub.contact.gap import force_of, is_within_bounds, normal_of, position_of, rise_of
from bladerub.contact.kernel import rigid
from bladerub.contact.kernel.abradable import wrap
from bladerub.contact.kernel.vectors import LANES, address_of, load, read, read_fields, store, write
from bladerub.contact.tip import coverage, relief

FOUND = 1e-12
"""Error of a node's height at which its force is taken as found, m."""
ATTEMPTS = 40
SWEEPS = 200


@njit
def relax(motion, stator, tip, state, passed, u, settled):
    """Find the contact forces that agree with the displacement they cause, by Gauss-Seidel sweeps.

    Parameters
    ----------
    u : address
        Comes as the displacement (16,) under ``state.force`` and leaves under the forces found, m.
    settled : float
        Change of any node's height in a sweep at which the forces are taken as found, m.
    """
    force, push = state.force, state.push
    position, surface = state.scratch, address_of(state.scratch, 16)
    rise, turned = address_of(state.scratch, 32), address_of(state.scratch, 48)
    for _ in range(SWEEPS):
        if not is_within_bounds(tip, load(u, 0), load(u, LANES)):
            break
        change = 0.0
        here = position_of(tip, load(u, LANES), passed)
        store(position, 0, here)
        if stator.is_rigid:
            store(surface, 0, rigid.surface(stator, here))
        if stator.reverses:
            height = rise_of(tip, load(u, 0), load(u, LANES))
            across, along = normal_of(tip, load(u, 0), load(u, LANES), height)
            friction.take_hold(motion, stator, tip, state, across, along, height)
        for j in range(LANES):
            own, guess = _own_compliance(motion, stator, state, j), read(push, j)
            store(rise, 0, rise_of(tip, load(u, 0), load(u, LANES)))
            free_rise = read(rise, j) + own * guess
            if stator.is_rigid:
                found = max(0.0, free_rise - read(surface, j)) / own
            else:
                found = _push_of(stator, tip, state.wear, j, read(position, j), free_rise, own, guess)
            if found == 0.0 and guess == 0.0:
                continue
            change = max(change, own * abs(found - guess))
            write(push, j, found)
            across, along = normal_of(tip, load(u, 0), load(u, LANES), load(rise, 0))
            radial, tangential = force_of(stator, load(state.along, 0), across, along, load(push, 0))
            store(turned, 0, radial)
            store(turned, LANES, tangential)
            for k in (j, LANES + j):
                by = read(turned, k) - read(force, k)
                write(force, k, read(turned, k))
                for i in range(0, 2 * LANES, LANES):
                    store(u, i, load(u, i) + load(motion.compliance, 16 * k + i) * by)
        if change <= settled:
            break


@njit
def _own_compliance(motion, stator, state, j):
    """Retreat of node `j` per unit of its own force in the direction that friction gives to that, m/N."""
    turned = stator.tangential - read(state.along, j)
    return max(0.0, read(stator.own_compliance, j) + turned * read(motion.compliance, 16 * j + LANES + j))


@njit
def _push_of(stator, tip, wear, j, position, free_rise, own, guess):
    """Push of the coating on node `j`, which gives way by `own` per unit of it, N.

    Solves ``rise + own P(rise) = free_rise`` by Newton's method within a bracket: P is piecewise linear, so
    it ends in a few steps.
    """
    low, high = -np.inf, np.inf
    rise = free_rise - own * guess
    for _ in range(ATTEMPTS):
        push, stiffness = _resistance(stator, tip, wear, j, position, rise)
        error = rise + own * push - free_rise
        if abs(error) <= FOUND:
            break
        if error > 0.0:
            high = rise
        else:
            low = rise
        rise -= error / (1.0 + own * stiffness)
        if not low < rise < high:  # or it would go round between two pieces
            rise = 0.5 * (low + high)
    return push


@njit
def _resistance(stator, tip, wear, j, position, rise):
    """Force (N) and stiffness (N/m) of the bars under node `j`, as `abradable.push_at`."""
    push = 0.0
    stiffness = 0.0
    element = read_fields(law.Element, address_of(stator.law, j))
    first = math.floor(position - tip.half_width)
    last = math.floor(position + tip.half_width)
    for i in range(first, last + 1):
        offset = i + 0.5 - position
        entry = wrap(i, stator.n_elements) * LANES + j
        worn = read(wear, entry)
        depth = rise - relief(tip, offset) - read(stator.gap, entry) - worn
        force, _ = law.return_mapping(element, depth, worn)
        slope, _ = law.tangent(element, depth, worn)
        share = coverage(tip, offset)
        push += share * force
        stiffness += share * slope
    return push, stiffness
