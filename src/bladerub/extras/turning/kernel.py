"""The functions of the time loop where the profile of the tip turns with the blade.

Its tilt is a second unknown of each node, and the couple of the elements a second force. Each function takes
the place of the one that its decorator names (`bladerub.contact.laws`).
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bladerub.contact import energy, law
from bladerub.contact.gap import is_above
from bladerub.contact.kernel import accounting, elements, gauss_seidel, newton
from bladerub.contact.kernel import modal as modes
from bladerub.contact.kernel.modal import ROWS
from bladerub.contact.tip import coverage, edge, highest
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import (
    add_lane_products,
    add_products,
    add_to,
    add_to_number,
    address_of,
    broadcast_each,
    broadcast_lanes,
    load,
    load_fields,
    no_lane_sums,
    no_sums,
    read,
    read_fields,
    store,
    sum_of_lane_products,
    sum_of_products,
    write,
)
from bladerub.numerics.vectors import (
    LANES,
    absolute,
    all_lanes,
    broadcast,
    halves,
    lane_sums,
    minimum,
)

TILT, COUPLE = 3 * LANES, 2 * LANES
"""Where in `State.u` the tilt is (m per element), and in `State.force` the couples (N elements)."""
WIDTH = ROWS + LANES
"""Coordinates of the tip: those of its nodes, then the tilt of each profile."""


COUNTERPARTS: dict[Callable, Callable] = {}
"""The functions below, each by that in whose place it is."""


def in_place_of(function: Callable) -> Callable[[Callable], Callable]:
    """Decorate the counterpart of a function of the loop, which has the same arguments."""

    def decorate(counterpart: Callable) -> Callable:
        COUNTERPARTS[function] = inlined(counterpart)
        return counterpart

    return decorate


class Displacement(NamedTuple):
    """Of the tip; vectors."""

    radial: np.ndarray  # m
    tangential: np.ndarray
    tilt: np.ndarray  # m per element


class Pose(NamedTuple):
    """How the profile of each node is to the casing; vectors."""

    approach: np.ndarray  # m
    tilt: np.ndarray  # m per element


class Linearisation(NamedTuple):
    """What the elements under each node answer near a pose; vectors."""

    pose: Pose
    force: np.ndarray  # N
    stiffness: np.ndarray  # N/m
    valid: np.ndarray  # As of `bladerub.contact.kernel.elements.Linearisation`
    couple: np.ndarray  # First moment of the force about the node, N elements
    first_moment: np.ndarray  # Of the stiffness about the node: force per tilt, and couple per approach
    second_moment: np.ndarray  # Couple per tilt


# ---- from the modes to the tip, and back (`bladerub.contact.kernel.modal`)


@in_place_of(modes.no_tip_displacement)
def no_tip_displacement():
    """Give sums for the nodes and for the tilt."""
    return no_sums(), no_lane_sums()


@in_place_of(modes.add_tip_displacement)
def add_tip_displacement(modal, k, x, sums):
    """Add what the modes move and tilt."""
    of_nodes, of_tilt = sums
    of_nodes = add_products(of_nodes, address_of(modal.tip, ROWS * k), x)
    return of_nodes, add_lane_products(of_tilt, address_of(modal.further, LANES * k), x)


@in_place_of(modes.tip_displacement)
def tip_displacement(sums):
    """Displacement and tilt from the sums."""
    of_nodes, of_tilt = sums
    radial, tangential = halves(of_nodes)
    return Displacement(lane_sums(radial), lane_sums(tangential), lane_sums(of_tilt))


@in_place_of(modes.spread_forces)
def spread_forces(force):
    """Each force, and each couple, in all lanes of a vector."""
    return broadcast_each(force), broadcast_lanes(address_of(force, COUPLE))


@in_place_of(modes.modal_force)
def modal_force(modal, k, forces):
    """Modal force of forces and couples."""
    of_nodes, couples = forces
    by_forces = sum_of_products(address_of(modal.tip, ROWS * k), of_nodes)
    return by_forces + sum_of_lane_products(address_of(modal.further, LANES * k), couples)


@in_place_of(modes.displacement_of_nodes)
def displacement_of_nodes(radial, tangential):
    """Displacement without a tilt."""
    return Displacement(radial, tangential, broadcast(0.0))


@in_place_of(modes.store_tip)
def store_tip(u, displacement, approach):
    """Store the tilt as well."""
    store(u, 0, displacement.radial)
    store(u, LANES, displacement.tangential)
    store(u, 2 * LANES, approach)
    store(u, TILT, displacement.tilt)


@in_place_of(modes.load_tip)
def load_tip(u):
    """Load the tilt as well."""
    return Displacement(load(u, 0), load(u, LANES), load(u, TILT))


@in_place_of(modes.move_tip)
def move_tip(modal, k, change, u):
    """Change the tilt as well."""
    block, lane = k // LANES, k % LANES
    for row in range(ROWS):
        by = read(modal.tip, LANES * (ROWS * block + row) + lane)
        add_to_number(u, row, by * change)
    for row in range(LANES):
        by = read(modal.further, LANES * (LANES * block + row) + lane)
        add_to_number(u, TILT + row, by * change)


@in_place_of(modes.displaced)
def displaced(modal, response, force, free):
    """Add what forces and couples cause."""
    radial, tangential, tilt = free
    more_radial = more_tangential = more_tilt = broadcast(0.0)  # two sums at the same time
    for i in range(0, WIDTH, 2):
        by, by_next = read(force, i), read(force, i + 1)
        radial = radial + load(response, WIDTH * i) * by
        tangential = tangential + load(response, WIDTH * i + LANES) * by
        more_radial = more_radial + load(response, WIDTH * (i + 1)) * by_next
        more_tangential = more_tangential + load(response, WIDTH * (i + 1) + LANES) * by_next
        tilt = tilt + load(response, WIDTH * i + ROWS) * by
        more_tilt = more_tilt + load(response, WIDTH * (i + 1) + ROWS) * by_next
    return Displacement(radial + more_radial, tangential + more_tangential, tilt + more_tilt)


# ---- the elements under the profile (`bladerub.contact.kernel.elements`)


@in_place_of(elements.pose_of)
def pose_of(approach, displacement):
    """Take the tilt of the displacement."""
    return Pose(approach, displacement.tilt)


@in_place_of(elements.load_pose)
def load_pose(u):
    """Load the tilt as well."""
    return Pose(load(u, 2 * LANES), load(u, TILT))


@in_place_of(elements.approach_at)
def approach_at(pose, offset):
    """Approach that is larger by the tilt."""
    return pose.approach + pose.tilt * offset


@in_place_of(elements.motion_at)
def motion_at(pose, before, offset, advance, lowering):
    """Count a change of tilt as work of the blade, and what the tilt lowers in passing as the rotation's."""
    middle = offset + 0.5 * advance
    closer = (pose.approach - before.approach) + (pose.tilt - before.tilt) * middle
    return closer, lowering - 0.5 * (pose.tilt + before.tilt) * advance


@in_place_of(elements.is_clear)
def is_clear(tip, radial, tangential, approach, u, minimum_gap):
    """Look at the highest point of each profile, where the nodes are clear."""
    clear = is_above(tip, radial, tangential, approach, minimum_gap)
    if clear:  # most steps near the casing end before
        clear = all_lanes(approach + highest(tip, absolute(load(u, TILT))) <= minimum_gap)
    return clear


@in_place_of(elements.no_linearisation)
def no_linearisation(pose):
    """Give one that holds nowhere."""
    zero = broadcast(0.0)
    return Linearisation(pose, zero, zero, broadcast(-1.0), zero, zero, zero)


@in_place_of(elements.linearise)
def linearise(stator, tip, state, position, rows, pose):
    """Sum up couple and moments as well."""
    element = load_fields(law.Element, stator.law)
    force, stiffness, valid = broadcast(0.0), broadcast(0.0), broadcast(math.inf)
    couple, first_moment, second_moment = broadcast(0.0), broadcast(0.0), broadcast(0.0)
    first, last = rows
    for row in range(first, last + 1):
        offset = (row + 0.5) - position
        share, approach = coverage(tip, offset), pose.approach + pose.tilt * offset
        force_here, slope, linear = elements.press(element, stator, tip, state, row, offset, approach)
        force = force + share * force_here
        stiffness = stiffness + share * slope
        valid = minimum(valid, linear)
        couple = couple + share * offset * force_here
        first_moment = first_moment + share * offset * slope
        second_moment = second_moment + share * offset * offset * slope
    return Linearisation(pose, force, stiffness, valid, couple, first_moment, second_moment)


# ---- the search for forces (`bladerub.contact.kernel.newton`)


@in_place_of(newton.add_response)
def add_response(free, response):
    """Add to the tilt as well."""
    return Displacement(
        free.radial + load(response, 0),
        free.tangential + load(response, LANES),
        free.tilt + load(response, 2 * LANES),
    )


@in_place_of(newton.store_response)
def store_response(response, free, moved):
    """Store that of the tilt as well."""
    store(response, 0, moved.radial - free.radial)
    store(response, LANES, moved.tangential - free.tangential)
    store(response, 2 * LANES, moved.tilt - free.tilt)


@in_place_of(newton.distance)
def distance(tip, pose, other):
    """Add what the edge of the profile is apart by the tilt."""
    return absolute(pose.approach - other.approach) + edge(tip) * absolute(pose.tilt - other.tilt)


@in_place_of(newton.newton_step)
def newton_step(stator, linear, pose, loaded):
    """Take approach and tilt of each node by themselves."""
    residual, tilt_residual = pose.approach - loaded.approach, pose.tilt - loaded.tilt
    return Pose(
        pose.approach - residual / (1.0 + load(stator.self_compliance, 0) * linear.stiffness),
        pose.tilt - tilt_residual / (1.0 + load(stator.further_compliance, 0) * linear.second_moment),
    )


@in_place_of(newton.answer)
def answer(stator, state, linear, pose):
    """Put the couple of the elements on the blade as well."""
    closer, turned = pose.approach - linear.pose.approach, pose.tilt - linear.pose.tilt
    couple = linear.couple + linear.first_moment * closer + linear.second_moment * turned
    store(state.force, COUPLE, stator.normal_factor * couple)
    return linear.force + linear.stiffness * closer + linear.first_moment * turned


# ---- the search node by node (`bladerub.contact.kernel.gauss_seidel`)


@in_place_of(gauss_seidel.width)
def width():
    """Count the tilts as well."""
    return WIDTH


@in_place_of(gauss_seidel.further_of)
def further_of(u, j):
    """Take the tilt."""
    return read(u, TILT + j)


@in_place_of(gauss_seidel.further_change)
def further_change(tip, u, j, before):
    """Look at the edge of the profile."""
    return edge(tip) * abs(read(u, TILT + j) - before)


@in_place_of(gauss_seidel.add_displacement)
def add_displacement(modal, u, row, by):
    """Add to the tilts as well."""
    for i in range(0, ROWS, LANES):
        store(u, i, load(u, i) + load(modal.compliance, row + i) * by)
    store(u, TILT, load(u, TILT) + load(modal.compliance, row + COUPLE) * by)


@in_place_of(gauss_seidel.resistance)
def resistance(stator, tip, state, j, position, approach, tilt, forces):
    """Sum up the couple as well."""
    force = stiffness = couple = 0.0
    element = read_fields(law.Element, address_of(stator.law, j))
    first = math.floor(position - tip.half_width)
    last = math.floor(position + tip.half_width)
    for i in range(first, last + 1):
        offset = i + 0.5 - position
        local_approach = approach + tilt * offset
        force_here, slope = gauss_seidel.press_one(element, stator, tip, state, i, j, offset, local_approach)
        share = coverage(tip, offset)
        force += share * force_here
        stiffness += share * slope
        couple += share * offset * force_here
    write(forces, COUPLE + j, stator.normal_factor * couple)
    return force, stiffness


# ---- the ledger (`bladerub.contact.kernel.accounting`)


@in_place_of(accounting.add_work)
def add_work(stator, tip, angle, state, u_after, u, u_before):
    """Add the work of the couples as well."""
    more_radial, more_tangential = accounting.add_work_of_forces(state, u_after, u_before)
    more_tilt = 0.5 * (load(u_after, TILT) - load(u_before, TILT))
    by_couple = load(state.force, 3 * LANES + COUPLE) * more_tilt
    add_to(state.ledger, energy.COUPLE * LANES, by_couple)
    if stator.tangential_factor != 0.0:
        # as `add_sliding`: the rest of what a turn takes from the tip
        ratio = (1.0 + stator.normal_factor) / stator.normal_factor
        add_to(state.ledger, energy.SLIDING * LANES, 0.0 - ratio * by_couple)
        radial, tangential = load(u, 0), load(u, LANES)
        accounting.add_sliding(stator, tip, angle, state, radial, tangential, more_radial, more_tangential)
