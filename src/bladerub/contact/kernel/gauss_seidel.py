"""Contact forces node by node, by Gauss-Seidel sweeps: slow and robust.

For the rigid casing, and for the few steps of stiff coatings in which the Newton iteration of
`bladerub.contact.kernel.newton` does not converge.
"""

import math

import numpy as np

from bladerub.contact import law
from bladerub.contact.friction import contact_force
from bladerub.contact.gap import closest_position, is_within_limit, normal, normal_approach
from bladerub.contact.kernel.coulomb import mobilise
from bladerub.contact.kernel.elements import linearise, rigid_surface
from bladerub.contact.kernel.modal import FURTHER
from bladerub.contact.tip import edge
from bladerub.numerics.machine_code import inlined, within
from bladerub.numerics.memory import WIDTH, add_to, address_of, load, read, read_fields, store, write
from bladerub.numerics.vectors import LANES

NODE_TOLERANCE = 1e-12  # error of a node's approach at which its own force has converged, m
MAX_NODE_ITERATIONS = 40
MAX_SWEEPS = 200


@within
def gauss_seidel(modal, stator, tip, state, travel, u, tolerance):
    """Find the contact forces that agree with the displacement they cause, eq. (9).

    `u` comes as the displacement (32,) under ``state.force`` and leaves under the forces found. They have
    converged where no approach, that of the profile's edge included, changes by more than `tolerance` (m) in
    a sweep. Returns whether they did, or a displacement exceeds the limit.
    """
    force, normal_force = state.force, state.normal_force
    position, surface = state.scratch, address_of(state.scratch, 2 * LANES)
    approaches, turned = address_of(state.scratch, 4 * LANES), address_of(state.scratch, 6 * LANES)
    for _ in range(MAX_SWEEPS):
        if not is_within_limit(tip, load(u, 0), load(u, LANES)):
            return True
        change, converged = 0.0, True
        positions = closest_position(tip, load(u, LANES), travel)
        store(position, 0, positions)
        if stator.is_rigid:
            store(surface, 0, rigid_surface(stator, positions))
        if stator.coulomb:
            towards = normal_approach(tip, load(u, 0), load(u, LANES))
            normal_radial, normal_tangential = normal(tip, load(u, 0), load(u, LANES), towards)
            mobilise(modal, stator, tip, state, normal_radial, normal_tangential, towards)
        for j in range(LANES):
            compliance, guess = _self_compliance(modal, stator, state, j), read(normal_force, j)
            further = read(u, FURTHER + j)  # stays as it is while the search looks at this node
            store(approaches, 0, normal_approach(tip, load(u, 0), load(u, LANES)))
            free_approach = read(approaches, j) + compliance * guess
            if stator.is_rigid:
                node_force = max(0.0, free_approach - read(surface, j)) / compliance  # eq. (9)
            else:
                place = read(position, j)
                node_force, node_converged = _force_on(
                    stator, tip, state, j, place, free_approach, further, compliance, guess, turned
                )
                converged = converged and node_converged
            if node_force == 0.0 and guess == 0.0:
                continue
            change = max(change, compliance * abs(node_force - guess))
            write(normal_force, j, node_force)
            towards = load(approaches, 0)
            normal_radial, normal_tangential = normal(tip, load(u, 0), load(u, LANES), towards)
            factor = load(state.tangential_factor, 0)
            radial, tangential = contact_force(
                stator.normal_factor, factor, normal_radial, normal_tangential, load(normal_force, 0)
            )
            store(turned, 0, radial)
            store(turned, LANES, tangential)
            for k in range(j, WIDTH, LANES):
                by = read(turned, k) - read(force, k)
                write(force, k, read(turned, k))
                for i in range(0, WIDTH, LANES):
                    add_to(u, i, load(modal.compliance, WIDTH * k + i) * by)
            change = max(change, edge(tip) * abs(read(u, FURTHER + j) - further))  # of the edge, m
        if change <= tolerance:
            return converged
    return False


@within
def _self_compliance(modal, stator, state, j):
    """Retreat of node `j` per unit of its own force in the direction that friction gives to that, m/N."""
    turned = stator.tangential_factor - read(state.tangential_factor, j)
    return max(0.0, read(stator.self_compliance, j) + turned * read(modal.compliance, WIDTH * j + LANES + j))


@within
def _force_on(stator, tip, state, j, position, free_approach, further, compliance, guess, forces):
    """Find the force N of the coating on node `j` at a given further coordinate.

    The node retreats by `compliance` per unit of it. Solves ``a + compliance N(a) = free_approach`` for the
    approach a by Newton's method within a bracket: N is piecewise linear, so it ends in a few steps. Returns
    N and whether it converged.
    """
    low, high = -np.inf, np.inf
    approach = free_approach - compliance * guess
    for _ in range(MAX_NODE_ITERATIONS):
        force, stiffness = resistance(stator, tip, state, j, position, approach, further, forces)
        residual = approach + compliance * force - free_approach
        if abs(residual) <= NODE_TOLERANCE:
            return force, True
        if residual > 0.0:
            high = approach
        else:
            low = approach
        approach -= residual / (1.0 + compliance * stiffness)
        if not low < approach < high:  # or it would alternate between two pieces
            approach = 0.5 * (low + high)
    return force, False


@inlined
def resistance(stator, tip, state, j, position, approach, further, forces):
    """Force (N) and stiffness (N/m) of the elements under node `j`.

    A counterpart enters the force along the further coordinate in `forces` (24,).
    """
    linear = node_linearisation(stator, tip, state, j, position, approach)
    return linear.force, linear.stiffness


@inlined
def node_linearisation(stator, tip, state, j, position, pose):
    """Press the elements under node `j`, as `elements.linearise`."""
    element = read_fields(law.Element, address_of(stator.law, j))
    rows = math.floor(position - tip.half_width), math.floor(position + tip.half_width)
    return linearise(element, stator, tip, state, position, rows, pose, read, j, 0.0)
