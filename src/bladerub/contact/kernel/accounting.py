"""Wear and energy of a step: the coating is updated once its forces are found, and the ledger kept."""

from bladerub.contact import energy
from bladerub.contact.gap import closest_position, normal, normal_approach, rotation_distance
from bladerub.contact.kernel import elements
from bladerub.contact.kernel.modal import APPROACH, load_tip
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import add_to, add_to_number, address_of, load, store
from bladerub.numerics.vectors import LANES, absolute, all_lanes, broadcast, maximum, where


@inlined
def update_coating(stator, tip, travel, per_step, state, u, u_before):
    """Wear the coating by the forces of this step, and enter energies and sliding in the ledger."""
    approach, normal_force = load(u, APPROACH), load(state.normal_force, 0)
    factor = load(state.tangential_factor, 0)
    position = closest_position(tip, load(u, LANES), travel)
    position_before = closest_position(tip, load(u_before, LANES), travel - per_step)
    _note_sliding(stator, state, normal_force, factor, position - position_before, per_step)
    if stator.is_rigid:
        stored, loss = broadcast(0.0), broadcast(0.0)
        shape = elements.rigid_surface(stator, position_before) - elements.rigid_surface(stator, position)
        supplied = 0.5 * (normal_force + load(state.normal_force, LANES)) * shape
    else:
        pose = elements.pose_of(approach, load_tip(u))
        pose_before = elements.pose_of(load(u_before, APPROACH), load_tip(u_before))
        stored, loss, supplied, worn = elements.update_wear(
            stator, tip, state, position, position_before, pose, pose_before
        )
        add_to(state.ledger, energy.WORN * LANES, worn)
    store(state.moment, 0, (0.0 - factor) * normal_force * (load(tip.lever, 0) + approach))
    entry = state.ledger
    store(entry, energy.STORED_BEFORE * LANES, load(entry, energy.STORED * LANES))
    store(entry, energy.STORED * LANES, stored)
    store(entry, energy.LAST_WEAR * LANES, loss)
    store(entry, energy.LAST_SHAPE * LANES, supplied)
    add_to(entry, energy.WEAR * LANES, loss)
    add_to(entry, energy.SHAPE * LANES, supplied)
    add_to(entry, energy.EXCHANGED * LANES, absolute(supplied))


@inlined
def _note_sliding(stator, state, normal_force, factor, advance, per_step):
    """Note how far nodes in contact lag behind the rotation, and whether one stuck or slid back."""
    slid = where(normal_force > 0.0, advance, per_step)
    retreat = address_of(state.ledger, energy.RETREAT * LANES)
    store(retreat, 0, maximum(load(retreat, 0), per_step - slid))
    withheld = where(normal_force > 0.0, factor - stator.tangential_factor, 0.0)
    if not all_lanes((slid > 0.0) & (withheld <= 0.0)):
        add_to_number(state.ledger, energy.REVERSED * LANES, 1.0)


@inlined
def add_work(stator, tip, angle, state, u_after, u, u_before):
    """Add the work of the forces at `u`, over half of the path from the step before to the step after.

    The blade rotates by `angle` (rad) in a step. Sliding takes the tangential force times the distance over
    the casing. A unit of approach takes N from the tip, of which the blade gives N cos θ, sliding the rest.
    """
    entry, normal_force = state.ledger, load(state.normal_force, LANES)
    more_radial = 0.5 * (load(u_after, 0) - load(u_before, 0))
    more_tangential = 0.5 * (load(u_after, LANES) - load(u_before, LANES))
    by_radial = load(state.force, 3 * LANES) * more_radial
    by_tangential = load(state.force, 4 * LANES) * more_tangential
    add_to(entry, energy.RADIAL * LANES, by_radial)
    add_to(entry, energy.TANGENTIAL * LANES, by_tangential)
    add_to(entry, energy.EXCHANGED * LANES, absolute(by_radial) + absolute(by_tangential))
    add_to(entry, energy.TORQUE * LANES, load(state.moment, LANES))
    add_further_work(stator, state, u_after, u_before)
    if stator.tangential_factor != 0.0:
        radial, tangential = load(u, 0), load(u, LANES)
        towards = normal_approach(tip, radial, tangential)
        friction_force = (0.0 - load(state.tangential_factor, LANES)) * normal_force
        normal_radial, normal_tangential = normal(tip, radial, tangential, towards)
        rotation = rotation_distance(tip, angle, towards)
        sliding = rotation + normal_radial * more_tangential - normal_tangential * more_radial
        closer = normal_radial * more_radial + normal_tangential * more_tangential
        taken = friction_force * sliding - (1.0 + stator.normal_factor) * normal_force * closer
        add_to(entry, energy.SLIDING * LANES, taken)


@inlined
def add_further_work(stator, state, u_after, u_before):
    """Add the work of the forces along the further coordinates, of which there are none."""
