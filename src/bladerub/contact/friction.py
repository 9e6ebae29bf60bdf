"""Coulomb's law of friction along the casing, a lane a node.

A force of constant direction is turned by θ against the rotation whatever the tip does. Coulomb's opposes the
sliding of the tip over the casing: rotation and vibration together. With the coefficient μ = tan θ its
normal part is ``P cos θ`` for the push P of the bars, as under θ, and its tangential part ``g P sin θ`` with
a grip g from −1 to 1: 1 where the tip slides with the rotation, −1 where it slides back, between where it
sticks. Where rotation always prevails, g is 1 throughout, and both laws are one.

The grip is found with the forces of a step: from the way s that the tip would slide in this step without
friction, it is ``s / (γ P sin θ)``, brought into [−1, 1]. γ is the most that friction of 1 N under all
nodes takes from the way of each, so that no step overshoots: a single mass comes to rest in the step in which
it would turn, and nodes that hinder each other within a few. That needs no velocity below which friction
fades; with the step goes to zero what it replaces, the jump of Coulomb's law.

The way is counted as the scheme counts the work of its forces (`bladerub.contact.schemes`, contract 5), over
the modes that it resolves: there friction of all nodes together never drives the tip. Condensed modes have no
velocity, and what they store of friction they give back.
"""

from __future__ import annotations

from numba import njit

from bladerub.contact.kernel.modal import displacement, no_projection, project, respond
from bladerub.contact.kernel.vectors import LANES, address_of, load, store, where


@njit(forceinline=True)
def foresee(motion, tip, state, q, q_before, per_step):
    """Find the way of the tip over the casing, m, in the step of the forces to come if there were none.

    A force of the paper's scheme acts on the step that led to `q`; one of the exponential scheme on the
    steps before and after, of which the mean is meant.

    Parameters
    ----------
    q, q_before : address
        Modal coordinates of this step, without its forces, and of the one before.
    per_step : float
        Elements that the rotation passes in a step.
    """
    sums = no_projection()
    for k in range(0, motion.n, LANES):
        now, before = load(q, k), load(q_before, k)
        if motion.corrects:
            way = now - before
        else:
            way = 0.5 * (load(motion.now, k) * now - load(motion.before, k) * before - before)
        sums = project(motion, k, way, sums)
    radial, tangential = displacement(sums)
    store(state.drift, 0, radial)
    store(state.drift, LANES, tangential)
    store(state.drift, 2 * LANES, per_step / load(tip.per_metre, 0))


@njit
def take_hold(motion, stator, tip, state, normal_radial, normal_tangential, rise):
    """Find how the casing grips each node, under the pushes in ``state.push``."""
    push, without = load(state.push, 0), address_of(state.scratch, 4 * 2 * LANES)
    store(without, 0, stator.radial * normal_radial * push)
    store(without, LANES, stator.radial * normal_tangential * push)
    radial, tangential = respond(motion.mobility, without, load(state.drift, 0), load(state.drift, LANES))
    turned = load(state.drift, 2 * LANES) * (1.0 + rise / load(tip.lever, 0))
    slid = turned + normal_radial * tangential - normal_tangential * radial
    full = (0.0 - stator.tangential) * push * load(motion.stopping, 0)
    grip = where(slid > (0.0 - full), slid / full, -1.0)
    store(state.along, 0, where(slid > full, stator.tangential, stator.tangential * grip))
