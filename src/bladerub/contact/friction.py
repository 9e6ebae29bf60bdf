"""Direction of the contact force: turned by θ against the rotation, or by Coulomb's law against the sliding.

A force of constant direction is turned by θ against the rotation whatever the tip does. Coulomb's opposes the
sliding of the tip over the casing: rotation and vibration together. With the coefficient μ = tan θ its normal
part is ``N cos θ`` for the force N of the elements, as under θ, and its tangential part ``m N sin θ`` with a
mobilisation m from −1 to 1: 1 where the tip slides with the rotation, −1 where it slides back, between where
it sticks. Where rotation always prevails, m is 1 throughout, and both laws are one.

The mobilisation is found with the forces of a step: from the distance s that the tip would slide in this step
without friction, it is ``s / (γ N sin θ)``, limited to [−1, 1]. γ is the most that friction of 1 N under all
nodes takes from the sliding of each, so that no step overshoots: a single mass comes to rest in the step in
which it would turn, and nodes that hinder each other within a few. That needs no velocity below which
friction fades; as the step goes to zero it becomes the jump of Coulomb's law.

The distance is counted as the scheme counts the work of its forces (`bladerub.contact.schemes`, contract 5),
over the modes that it resolves: there friction of all nodes together never drives the tip. Condensed modes
have no velocity, and what they store of friction they give back.
"""

from __future__ import annotations

from numba import njit

from bladerub.contact.kernel.modal import add_tip_displacement, displaced, tip_displacement
from bladerub.numerics.vectors import LANES, address_of, broadcast, load, no_sums, store, where


@njit(inline="always")
def contact_force(stator, tangential_factor, normal_radial, normal_tangential, normal_force):
    """Split the contact force on the blade, F_r = −cos θ |F| e_r and F_θ = −sin θ |F| e_θ of the paper.

    Both directions are those at the displaced node. `tangential_factor` of each node is −sin θ, or what
    friction mobilises of it.

    Returns
    -------
    radial, tangential : vector
        By the node's own directions at rest, N.
    """
    return (
        normal_force * (stator.normal_factor * normal_radial - tangential_factor * normal_tangential),
        normal_force * (stator.normal_factor * normal_tangential + tangential_factor * normal_radial),
    )


@njit(inline="always")
def rotation_distance(tip, angle, approach):
    """Distance by which a rotation by `angle` (rad) moves each displaced node along the casing, m."""
    return angle * (load(tip.lever, 0) + approach)


@njit(forceinline=True)
def predict_sliding(modal, state, q, q_before, angle):
    """Find how far the tip would slide over the casing in this step without contact forces.

    A force of the paper's scheme acts on the step that led to `q`; one of the exponential scheme on the
    steps before and after, of which the mean is meant.

    Parameters
    ----------
    q, q_before : address
        Modal coordinates of this step, without its forces, and of the one before.
    angle : float
        By which the blade rotates in a step, rad.
    """
    sums = no_sums()
    for k in range(0, modal.n, LANES):
        now, before = load(q, k), load(q_before, k)
        if modal.corrects:
            increment = now - before
        else:
            increment = 0.5 * (load(modal.now, k) * now - load(modal.before, k) * before - before)
        sums = add_tip_displacement(modal, k, increment, sums)
    radial, tangential = tip_displacement(sums)
    store(state.free_sliding, 0, radial)
    store(state.free_sliding, LANES, tangential)
    store(state.free_sliding, 2 * LANES, broadcast(angle))


@njit
def mobilise(modal, stator, tip, state, normal_radial, normal_tangential, approach):
    """Find the tangential factor of each node by Coulomb's law, under the forces in `state.normal_force`."""
    normal_force, frictionless = load(state.normal_force, 0), address_of(state.scratch, 4 * 2 * LANES)
    store(frictionless, 0, stator.normal_factor * normal_radial * normal_force)
    store(frictionless, LANES, stator.normal_factor * normal_tangential * normal_force)
    radial, tangential = displaced(
        modal.mobility, frictionless, load(state.free_sliding, 0), load(state.free_sliding, LANES)
    )
    rotation = rotation_distance(tip, load(state.free_sliding, 2 * LANES), approach)
    sliding = rotation + normal_radial * tangential - normal_tangential * radial
    stopping = (0.0 - stator.tangential_factor) * normal_force * load(modal.stopping, 0)
    mobilised = where(sliding > (0.0 - stopping), sliding / stopping, -1.0)
    store(
        state.tangential_factor,
        0,
        where(sliding > stopping, stator.tangential_factor, stator.tangential_factor * mobilised),
    )
