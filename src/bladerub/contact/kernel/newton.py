"""Contact forces of a step, by Newton's method on the approach of all nodes at once.

The unknown is the pose of the profile of each node, which is its approach a to the casing. The forces N(a) of
the elements, which are piecewise linear, displace the tip from u₀ to ``u₀ + C F(N)``, C the compliance of the
scheme. Forces and displacement agree, eqs. (8) and (9), where the residual
``r(a) = a − n · (u₀ + C F(N(a)))`` vanishes. Normal n (into the casing), position and rows of elements are
those of a nearby displacement, and are found again when the nodes move along the casing.
"""

from typing import NamedTuple

import numpy as np

from bladerub.contact import law
from bladerub.contact.energy import FALLBACK, UNCONVERGED
from bladerub.contact.friction import contact_force
from bladerub.contact.gap import closest_position, is_within_limit, normal, normal_approach
from bladerub.contact.kernel.coulomb import mobilise
from bladerub.contact.kernel.elements import approach_at, linearise, pose_of, rows_under
from bladerub.contact.kernel.gauss_seidel import gauss_seidel
from bladerub.contact.kernel.modal import APPROACH, Displacement, displaced, load_tip, store_tip
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import add_to_number, clear, load, load_fields, store, store_fields
from bladerub.numerics.vectors import LANES, absolute, all_lanes, broadcast

TOLERANCE = 1e-11  # residual of any node's approach at which the contact forces have converged, m
STRAIGHT = 1e-8  # displacement along the casing over which normal and rows of elements are kept, m
MAX_ITERATIONS = 8  # Newton steps before the forces are sought node by node


class Geometry(NamedTuple):
    """Where the nodes are on the casing at a displacement of the tip; vectors, and two row numbers."""

    displacement: Displacement
    approach: np.ndarray
    normal_radial: np.ndarray
    normal_tangential: np.ndarray
    position: np.ndarray
    rows: tuple[int, int]


@inlined
def find_forces(modal, stator, tip, travel, state, u, coulomb):
    """Find the contact forces that agree with the displacement they cause, eqs. (8) and (9).

    `u` comes as the displacement without forces of this step and leaves under them. The response to the
    forces of the step before is the first guess. `coulomb` is a constant where this is compiled into the
    loop. Returns whether the displacement is within the limit.
    """
    element, zero = load_fields(law.Element, stator.law), broadcast(0.0)
    free = load_tip(u)  # u₀
    start = moved = free + load_tip(state.response)
    geometry = _geometry(tip, start, travel)  # eq. (7)
    pose = loaded = pose_of(geometry.approach, start)
    linear_pose, valid = pose, broadcast(-1.0)  # where elements were linearised: nowhere yet
    converged = False
    tried = not stator.is_rigid and is_within_limit(tip, start.radial, start.tangential)
    if tried:
        for _ in range(MAX_ITERATIONS):
            if not all_lanes(distance(tip, pose, linear_pose) <= valid):
                linear = linearise(
                    element, stator, tip, state, geometry.position, geometry.rows, pose, load, 0, zero
                )
                linear_pose, valid = pose, linear.valid
            moved = _displace(modal, stator, tip, state, geometry, linear, pose, free, coulomb)  # u₀ + C F
            change = moved - geometry.displacement
            loaded_approach = (  # n · u, eq. (8)
                geometry.approach
                + geometry.normal_radial * change.radial
                + geometry.normal_tangential * change.tangential
            )
            loaded = pose_of(loaded_approach, moved)
            is_straight = all_lanes(absolute(change.tangential) <= STRAIGHT)
            if is_straight and all_lanes(distance(tip, pose, loaded) <= TOLERANCE):  # r, eq. (9)
                converged = True
                break
            pose = newton_step(stator, linear, pose, loaded)
            if not is_straight:
                if not is_within_limit(tip, moved.radial, moved.tangential):
                    break
                geometry = _geometry(tip, moved, travel)
                valid = broadcast(-1.0)
    if converged:
        store_tip(u, moved, approach_at(loaded, 0.0))
    else:
        if tried:  # the iteration may have gone anywhere: begin again without forces
            clear(state.force, 3 * LANES)
            clear(state.normal_force, LANES)
        else:
            store_tip(u, start, geometry.approach)
        moved = _by_sweeps(modal, stator, tip, travel, state, u)
    store_fields(moved - free, state.response)
    return is_within_limit(tip, moved.radial, moved.tangential)


@inlined
def _geometry(tip, displacement, travel):
    radial, tangential = displacement.radial, displacement.tangential
    approach = normal_approach(tip, radial, tangential)
    normal_radial, normal_tangential = normal(tip, radial, tangential, approach)
    position = closest_position(tip, tangential, travel)
    rows = rows_under(tip, position, position)
    return Geometry(displacement, approach, normal_radial, normal_tangential, position, rows)


@inlined
def distance(tip, pose, other):
    """Most that two poses are apart for any point of each profile, m."""
    return absolute(pose - other)


@inlined
def newton_step(stator, linear, pose, loaded):
    """Return the next pose, from the one under its forces: the nodes are taken by themselves."""
    return pose - (pose - loaded) / (1.0 + load(stator.self_compliance, 0) * linear.stiffness)


@inlined
def answer(stator, state, linear, pose):
    """Force N of the elements under each node at a pose, by their linearisation."""
    return linear.force + linear.stiffness * (pose - linear.pose)


@inlined
def _displace(modal, stator, tip, state, geometry, linear, pose, free, coulomb):
    """Put the forces of the elements at a pose on the blade; return the displacement under them."""
    normal_force = answer(stator, state, linear, pose)
    store(state.normal_force, 0, normal_force)
    if coulomb:
        approach = approach_at(pose, 0.0)
        mobilise(modal, stator, tip, state, geometry.normal_radial, geometry.normal_tangential, approach)
        factor = load(state.tangential_factor, 0)
    else:
        factor = broadcast(stator.tangential_factor)
    by_radial, by_tangential = contact_force(
        stator.normal_factor, factor, geometry.normal_radial, geometry.normal_tangential, normal_force
    )
    store(state.force, 0, by_radial)
    store(state.force, LANES, by_tangential)
    return displaced(modal.compliance, state.force, free)


@inlined
def _by_sweeps(modal, stator, tip, travel, state, u):
    """Find the forces node by node, from those in `state`; count how often, and how that ends."""
    converged = gauss_seidel(modal, stator, tip, state, travel, u, TOLERANCE)
    if not stator.is_rigid:
        add_to_number(state.ledger, FALLBACK * LANES, 1.0)
    if not converged:
        add_to_number(state.ledger, UNCONVERGED * LANES, 1.0)
    moved = load_tip(u)
    store(u, APPROACH, normal_approach(tip, moved.radial, moved.tangential))
    return moved
