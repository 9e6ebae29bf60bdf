"""Coulomb's law of friction in the time loop (`bladerub.contact.friction`), a lane a node."""

from bladerub.contact.friction import mobilisation
from bladerub.contact.gap import rotation_distance
from bladerub.contact.kernel.modal import (
    APPROACH,
    add_tip_displacement,
    displaced,
    load_tip,
    store_tip,
    tip_displacement,
)
from bladerub.numerics.machine_code import inlined, within
from bladerub.numerics.memory import address_of, copy, load, no_sums, store
from bladerub.numerics.vectors import LANES, broadcast


@inlined
def predict_sliding(modal, state, q, q_before, angle):
    """Find how far the tip would slide over the casing in this step without contact forces.

    A force of the paper's scheme acts on the step that led to `q`, which is without its forces; one of the
    exponential scheme on the steps before and after, of which the mean is meant. The blade rotates by `angle`
    (rad) in a step.
    """
    sums = no_sums()
    for k in range(0, modal.n, LANES):
        present, before = load(q, k), load(q_before, k)
        if modal.corrects:
            increment = present - before
        else:
            increment = 0.5 * (load(modal.now, k) * present - load(modal.before, k) * before - before)
        sums = add_tip_displacement(modal, k, increment, sums)
    store_tip(state.free_sliding, tip_displacement(sums), broadcast(angle))


@within
def mobilise(modal, stator, tip, state, normal_radial, normal_tangential, approach):
    """Find the tangential factor of each node by Coulomb's law, under the forces in `state.normal_force`."""
    normal_force, frictionless = load(state.normal_force, 0), address_of(state.scratch, 4 * 2 * LANES)
    copy(state.force, frictionless, 3 * LANES)
    store(frictionless, 0, stator.normal_factor * normal_radial * normal_force)
    store(frictionless, LANES, stator.normal_factor * normal_tangential * normal_force)
    moved = displaced(modal.mobility, frictionless, load_tip(state.free_sliding))
    rotation = rotation_distance(tip, load(state.free_sliding, APPROACH), approach)
    sliding = rotation + normal_radial * moved.tangential - normal_tangential * moved.radial
    stopping = (0.0 - stator.tangential_factor) * normal_force * load(modal.stopping, 0)
    store(state.tangential_factor, 0, stator.tangential_factor * mobilisation(sliding, stopping))
