"""The abradable elements under the tip's nodes (Fig. 3), or the rigid casing, a lane a node."""

import math
from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.gap import penetration
from bladerub.contact.kernel import tilt
from bladerub.contact.tip import coverage, relief
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

HEATS = hasattr(law, "strength")
"""Whether the forces of an element depend on its temperature (`bladerub.contact.heating`)."""
NO_CHANGE = 1e-12
"""Change of depth below which the force of an element is taken as constant over a step, m."""


class Placement(NamedTuple):
    """Where the profiles are on the casing; a vector each."""

    position: np.ndarray  # Of the nodes, in rows
    approach: np.ndarray  # m
    tilted: np.ndarray  # m per element


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
def linearise(tilts, stator, tip, state, position, rows, approach, tilted):
    """Press the elements under each node by its `approach` and tilt, but leave them as they are.

    Returns force (N), stiffness (N/m), and the change of depth over which the force is linear (m): no element
    comes into contact, begins to flow or to unload. And where the profile turns, where `tilts` is
    ``modal.tilt`` and not None, the first moment of the force about the node (N elements), the first and the
    second moment of the stiffness.
    """
    element = load_fields(law.Element, stator.law)
    force, stiffness, valid = broadcast(0.0), broadcast(0.0), broadcast(math.inf)
    couple, first_moment, second_moment = broadcast(0.0), broadcast(0.0), broadcast(0.0)
    first, last = rows
    for row in range(first, last + 1):
        entry = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share = coverage(tip, offset)
        worn = load(state.wear, entry)
        local_approach = tilt.raised(tilts, approach, tilted, offset)
        depth = penetration(local_approach, relief(tip, offset), load(stator.initial_gap, entry), worn)
        force_here, _ = law.return_mapping(element, depth, worn)
        slope, linear = law.tangent(element, depth, worn)
        if HEATS:
            strength = load(state.strength, entry)
            force_here, slope = strength * force_here, strength * slope
        force = force + share * force_here
        stiffness = stiffness + share * slope
        valid = minimum(valid, linear)
        if tilts is not None:
            couple = couple + share * offset * force_here
            first_moment = first_moment + share * offset * slope
            second_moment = second_moment + share * offset * offset * slope
    return force, stiffness, valid, couple, first_moment, second_moment


@inlined
def update_wear(tilts, stator, tip, state, placement, before):
    """Leave the elements as the tip presses them at the end of a step, and account for it.

    An element partly under the tip counts as elements of which a share is under it: as the edge of the
    profile moves on, whole elements are pressed down or released, at the cost or to the profit of the
    rotation. Between the ends of the step, approach and profile change linearly, and the law is integrated
    exactly along that path. What the depth changes by a change of tilt is work of the blade, the rest of what
    it changes by the profile is work of the rotation.

    `placement` and `before` are `Placement`, less than N rows from each other. Returns the elastic energy in
    the elements, the energy taken by wear and the work of the rotation on the elements in this step, J, and
    what the elements wear in it, m.
    """
    position, approach, tilted = placement
    position_before, approach_before, tilted_before = before
    element = load_fields(law.Element, stator.law)
    stored, dissipated, supplied, worn_off = broadcast(0.0), broadcast(0.0), broadcast(0.0), broadcast(0.0)
    first, last = rows_under(tip, minimum(position, position_before), maximum(position, position_before))
    advance, closer = position - position_before, approach - approach_before
    constant, slope = relief(tip, advance), 2.0 * tip.curvature * advance
    # Of friction, J per N of the force of an element; the tip slides over the casing by `advance`
    by_friction = (0.0 - load(state.tangential_factor, 0)) * advance / load(tip.per_metre, 0)
    for row in range(first, last + 1):
        entry = wrap(row, stator.n_elements) * LANES
        offset = (row + 0.5) - position
        share, share_before = coverage(tip, offset), coverage(tip, offset + advance)
        lowering = slope * offset + constant  # of the profile over this element, in the step
        worn = load(state.wear, entry)
        local_approach, turning = tilt.raised(tilts, approach, tilted, offset), closer
        if tilts is not None:
            middle = offset + 0.5 * advance
            turning = closer + (tilted - tilted_before) * middle
            lowering = lowering - 0.5 * (tilted + tilted_before) * advance
        depth = penetration(local_approach, relief(tip, offset), load(stator.initial_gap, entry), worn)
        deeper = turning + lowering
        force, increment = law.return_mapping(element, depth, worn)
        force_before = law.elastic_force(element, depth - deeper)
        under, was_under = share > 0.0, share_before > 0.0
        increment, force = where(under, increment, 0.0), where(under, force, 0.0)
        store(state.wear, entry, worn + increment)
        worn_off = worn_off + increment
        energy, energy_before = law.stored_energy(element, force), law.stored_energy(element, force_before)
        loss = law.dissipated_energy(element, worn, increment, where(was_under, force_before, 0.0), force)
        if HEATS:
            strength = load(state.strength, entry)
            force, force_before = strength * force, strength * force_before
            energy, energy_before, loss = strength * energy, strength * energy_before, strength * loss
            add_to(state.heat, 2 * entry, loss)
            mean = 0.5 * (share * force + share_before * force_before)
            add_to(state.heat, 2 * entry + LANES, mean * by_friction)
        stored = stored + share * energy
        dissipated = dissipated + loss
        mean_share = 0.5 * (share + share_before)
        moved = absolute(deeper) > NO_CHANGE
        mean_force = where(moved, (energy - energy_before + loss) / where(moved, deeper, 1.0), force)
        staying = (
            mean_share * mean_force * lowering
            + 0.5 * (energy + energy_before) * (share - share_before)
            + (1.0 - mean_share) * loss
        )
        entering, leaving = share * energy + loss, broadcast(0.0) - share_before * energy_before
        supplied = supplied + where(under, where(was_under, staying, entering), leaving)
    return stored, dissipated, supplied, worn_off
