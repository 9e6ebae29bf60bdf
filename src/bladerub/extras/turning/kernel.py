"""The functions of the time loop where the profile of the tip turns with the blade.

Its tilt (m per element) is the further coordinate of each node, and the couple of the elements (N elements)
the force along it. Each function takes the place of the one of `contact.kernel` that its decorator names.
"""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from bladerub.contact import energy
from bladerub.contact.gap import is_above
from bladerub.contact.kernel import accounting, elements, gauss_seidel, newton
from bladerub.contact.kernel.modal import FURTHER
from bladerub.contact.tip import coverage, edge, highest
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import add_to, load, store, write
from bladerub.numerics.vectors import LANES, absolute, all_lanes, minimum

COUNTERPARTS: dict[Callable, Callable] = {}  # the functions below, each by that in whose place it is


def in_place_of(function: Callable) -> Callable[[Callable], Callable]:
    """Decorate the counterpart of a function of the loop, which has the same arguments."""

    def decorate(counterpart: Callable) -> Callable:
        COUNTERPARTS[function] = inlined(counterpart)
        return counterpart

    return decorate


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


@in_place_of(elements.pose_of)
def pose_of(approach, displacement):
    """Take the tilt of the displacement."""
    return Pose(approach, displacement.further)


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
        clear = all_lanes(approach + highest(tip, absolute(load(u, FURTHER))) <= minimum_gap)
    return clear


@in_place_of(elements.linearise)
def linearise(element, stator, tip, state, position, rows, pose, fetch, lane, zero):
    """Sum up couple and moments as well."""
    force, stiffness, valid = zero, zero, zero + math.inf
    couple, first_moment, second_moment = zero, zero, zero
    first, last = rows
    for row in range(first, last + 1):
        offset = (row + 0.5) - position
        share, approach = coverage(tip, offset), pose.approach + pose.tilt * offset
        force_here, slope, linear = elements.press(
            element, stator, tip, state, row, offset, approach, fetch, lane
        )
        force = force + share * force_here
        stiffness = stiffness + share * slope
        valid = minimum(valid, linear)
        couple = couple + share * offset * force_here
        first_moment = first_moment + share * offset * slope
        second_moment = second_moment + share * offset * offset * slope
    return Linearisation(pose, force, stiffness, valid, couple, first_moment, second_moment)


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
    store(state.force, FURTHER, stator.normal_factor * couple)
    return linear.force + linear.stiffness * closer + linear.first_moment * turned


@in_place_of(gauss_seidel.resistance)
def resistance(stator, tip, state, j, position, approach, tilt, forces):
    """Enter the couple as well."""
    pose = Pose(approach, tilt)
    linear = gauss_seidel.node_linearisation(stator, tip, state, j, position, pose)
    write(forces, FURTHER + j, stator.normal_factor * linear.couple)
    return linear.force, linear.stiffness


@in_place_of(accounting.add_further_work)
def add_further_work(stator, state, u_after, u_before):
    """Add the work of the couples."""
    more_tilt = 0.5 * (load(u_after, FURTHER) - load(u_before, FURTHER))
    by_couple = load(state.force, 3 * LANES + FURTHER) * more_tilt
    add_to(state.ledger, energy.COUPLE * LANES, by_couple)
    if stator.tangential_factor != 0.0:  # the rest of what a turn takes from the tip
        ratio = (1.0 + stator.normal_factor) / stator.normal_factor
        add_to(state.ledger, energy.SLIDING * LANES, 0.0 - ratio * by_couple)
