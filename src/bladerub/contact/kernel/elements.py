"""The abradable elements under the tip's nodes (Fig. 3), or the rigid casing, a lane a node."""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.gap import is_above, penetration
from bladerub.contact.kernel.records import LAYER_NUMBERS
from bladerub.contact.tip import coverage, mean_coverage, relief
from bladerub.numerics.machine_code import inlined, within
from bladerub.numerics.memory import add_to, load, load_fields, store
from bladerub.numerics.vectors import (
    LANES,
    absolute,
    broadcast,
    largest_lane,
    maximum,
    minimum,
    smallest_lane,
    where,
)

NO_CHANGE = 1e-12  # change of depth below which the force of an element is taken as constant over a step, m
NO_ADVANCE = 1e-9  # least distance that the tip counts as passing in a step, in elements: it divides


class Linearisation(NamedTuple):
    """What the elements under each node answer near a pose; vectors."""

    pose: np.ndarray  # How each profile is to the casing: approach of its node, m
    force: np.ndarray  # N
    stiffness: np.ndarray  # N/m
    valid: np.ndarray  # Change of depth, m, in which none comes into contact, begins to flow or to unload


@inlined
def pose_of(approach, displacement):
    """Pose of the profiles at a displacement of the tip, by which the nodes approach the casing."""
    return approach


@inlined
def approach_at(pose, offset):
    """Approach of the profile to the casing at `offset` elements from the node, m, without its relief."""
    return pose


@inlined
def motion_at(pose, before, offset, advance, lowering):
    """Split what a profile comes closer by between two poses: by the blade, and by the rotation, m.

    The second is the `lowering` of the profile over an element, which it passes by `advance` elements.
    """
    return pose - before, lowering


@inlined
def is_clear(tip, radial, tangential, approach, u, minimum_gap):
    """Whether the tip surely touches nothing: its closest profile is above the lowest surface in reach.

    `u` is the displacement as it was stored.
    """
    return is_above(tip, radial, tangential, approach, minimum_gap)


@inlined
def wrap(index, n_elements):
    """Bring an index less than one turn outside into [0, N)."""
    if index >= n_elements:
        return index - n_elements
    if index < 0:
        return index + n_elements
    return index


@inlined
def rows_under(tip, rear, front):
    """First and last row that the profile covers of any node between positions `rear` and `front`."""
    first = math.floor(smallest_lane(rear) - tip.half_width)
    return first, math.floor(largest_lane(front) + tip.half_width)


@within
def rigid_surface(stator, position):
    """Return the initial gap to the rigid casing, which no node may pass, eq. (9), m.

    The surface is smooth through the centres of the elements.
    """
    gap = broadcast(0.0)
    for row in range(math.floor(smallest_lane(position)) - 1, math.floor(largest_lane(position)) + 2):
        weight = maximum(1.0 - absolute((row + 0.5) - position), 0.0)
        gap = gap + weight * load(stator.initial_gap, wrap(row, stator.n_elements) * LANES)
    return gap


@inlined
def press(element, stator, tip, state, row, offset, approach, fetch, lane):
    """Press the element in `row` under each node, but leave it as it is.

    `fetch` and `lane` are as of `linearise`. Returns its force (N), its stiffness (N/m), and the change of
    depth over which these hold (m).
    """
    entry = wrap(row, stator.n_elements) * LANES + lane
    worn = fetch(state.wear, entry)
    depth = penetration(approach, relief(tip, offset), fetch(stator.initial_gap, entry), worn)
    force, _ = law.return_mapping(element, depth, worn)
    stiffness, linear = law.tangent(element, depth, worn)
    if LAYER_NUMBERS:
        strength = fetch(state.strength, entry)
        force, stiffness = strength * force, strength * stiffness
    return force, stiffness, linear


@inlined
def linearise(element, stator, tip, state, position, rows, pose, fetch, lane, zero):
    """Press the elements under each node by its profile, and sum up what they answer.

    With `load` as `fetch`, `lane` 0 and a vector `zero` of all nodes; with `read`, its lane and 0.0 of one.
    """
    force, stiffness, valid = zero, zero, zero + math.inf
    first, last = rows
    for row in range(first, last + 1):
        offset = (row + 0.5) - position
        share = coverage(tip, offset)
        force_here, slope, linear = press(element, stator, tip, state, row, offset, pose, fetch, lane)
        force = force + share * force_here
        stiffness = stiffness + share * slope
        valid = minimum(valid, linear)
    return Linearisation(pose, force, stiffness, valid)


@inlined
def update_wear(stator, tip, state, position, position_before, pose, pose_before):
    """Leave the elements as the tip presses them at the end of a step, and account for it.

    An element partly under the tip counts as elements of which a share is under it: as the edge of the
    profile moves on, whole elements are pressed down or released, at the cost or to the profit of the
    rotation. Between the ends of the step, approach and profile change linearly, and both the law and the
    share are integrated exactly along that path. Of the energy that the elements take, the rotation supplies
    what the blade does not by coming closer: its way times the mean of share times force.

    Positions (rows) and poses are those at the end of the step and before, less than N rows from each other.
    Returns the elastic energy in the elements, the energy taken by wear and the work of the rotation on the
    elements in this step, J, and what the elements wear in it, m.
    """
    element = load_fields(law.Element, stator.law)
    stored, dissipated, supplied, worn_off = broadcast(0.0), broadcast(0.0), broadcast(0.0), broadcast(0.0)
    first, last = rows_under(tip, minimum(position, position_before), maximum(position, position_before))
    advance = position - position_before
    constant, slope = relief(tip, advance), 2.0 * tip.curvature * advance
    per_advance = 1.0 / maximum(absolute(advance), NO_ADVANCE)
    # Of friction, J per N of the force of an element; the tip slides over the casing by `advance`
    by_friction = (0.0 - load(state.tangential_factor, 0)) * advance / load(tip.per_metre, 0)
    for row in range(first, last + 1):
        entry = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share, share_before = coverage(tip, offset), coverage(tip, offset + advance)
        lowering = slope * offset + constant  # of the profile over this element, in the step
        worn = load(state.wear, entry)
        closer, lowering = motion_at(pose, pose_before, offset, advance, lowering)
        approach = approach_at(pose, offset)
        depth = penetration(approach, relief(tip, offset), load(stator.initial_gap, entry), worn)
        deeper = closer + lowering
        force, increment = law.return_mapping(element, depth, worn)
        force_before = law.elastic_force(element, depth - deeper, worn)
        under, was_under = share > 0.0, share_before > 0.0
        increment, force = where(under, increment, 0.0), where(under, force, 0.0)
        store(state.wear, entry, worn + increment)
        worn_off = worn_off + increment
        energy, energy_before = law.stored_energy(element, force), law.stored_energy(element, force_before)
        loss = law.dissipated_energy(element, worn, increment, where(was_under, force_before, 0.0), force)
        if LAYER_NUMBERS:
            strength = load(state.strength, entry)
            force, force_before = strength * force, strength * force_before
            energy, energy_before, loss = strength * energy, strength * energy_before, strength * loss
            add_to(state.taken, 2 * entry, loss)
            mean = 0.5 * (share * force + share_before * force_before)
            add_to(state.taken, 2 * entry + LANES, mean * by_friction)
        stored = stored + share * energy
        dissipated = dissipated + loss
        moved, stays = absolute(deeper) > NO_CHANGE, under & was_under
        work = energy - energy_before + loss
        mean_force = where(moved, work / where(moved, deeper, 1.0), force)
        mean_force = where(stays, mean_force, where(under, force, force_before))
        mean_share = mean_coverage(share, share_before, per_advance)
        # the mean of the product of two linear courses exceeds that of their means by Δ Δ / 12
        excess = where(stays, (share - share_before) * (force - force_before) / 12.0, 0.0)
        by_blade = (mean_share * mean_force + excess) * closer
        supplied = supplied + (share * energy - share_before * energy_before + loss - by_blade)
    return stored, dissipated, supplied, worn_off
