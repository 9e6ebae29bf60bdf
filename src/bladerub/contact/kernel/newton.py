"""Contact forces of a step, by Newton's method on the approach of all nodes at once.

The unknown is the approach a of each node to the casing. The forces N(a) of the elements, which are piecewise
linear, displace the tip from u₀ to ``u₀ + C F(N)``, C the compliance of the scheme. Forces and displacement
agree, eqs. (8) and (9), where the residual ``r(a) = a − n · (u₀ + C F(N(a)))`` vanishes. Normal n, position
and rows of elements are those of a nearby displacement, and are found again when the nodes move along the
casing. Where the profile turns, its tilt is a second unknown of each node, and the couple of the elements a
second force.
"""

from typing import NamedTuple

import numpy as np

from bladerub.contact.energy import FALLBACK, UNCONVERGED
from bladerub.contact.friction import contact_force
from bladerub.contact.gap import closest_position, is_within_limit, normal, normal_approach
from bladerub.contact.kernel import elements, tilt
from bladerub.contact.kernel.coulomb import mobilise
from bladerub.contact.kernel.gauss_seidel import gauss_seidel
from bladerub.contact.kernel.modal import displaced
from bladerub.contact.tip import edge
from bladerub.numerics.machine_code import inlined
from bladerub.numerics.memory import add_to_number, clear, load, store
from bladerub.numerics.vectors import LANES, absolute, all_lanes, broadcast

TOLERANCE = 1e-11
"""Residual of any node's approach at which the contact forces have converged, m."""
STRAIGHT = 1e-8
"""Displacement along the casing over which normal and rows of elements are kept, m."""
MAX_ITERATIONS = 8
"""Newton steps before the forces are sought node by node."""


class Geometry(NamedTuple):
    """Where the nodes are on the casing at a displacement of the tip; vectors, and two row numbers."""

    radial: np.ndarray
    tangential: np.ndarray
    approach: np.ndarray
    normal_radial: np.ndarray
    normal_tangential: np.ndarray
    position: np.ndarray
    rows: tuple[int, int]


class Linearisation(NamedTuple):
    """Forces and stiffness of the elements at an approach and tilt, and the change over which they hold."""

    approach: np.ndarray
    tilted: np.ndarray
    force: np.ndarray
    stiffness: np.ndarray
    valid: np.ndarray
    couple: np.ndarray
    first_moment: np.ndarray  # Of the stiffness about the node: force per tilt, and couple per approach
    second_moment: np.ndarray  # Couple per tilt


@inlined
def find_forces(modal, stator, tip, travel, state, u, coulomb):
    """Find the contact forces that agree with the displacement they cause.

    `u` comes as the displacement without forces of this step and leaves under them. The response to the
    forces of the step before is the first guess. `coulomb` is a constant where this is compiled into the
    loop. Returns whether the displacement is within the limit.
    """
    free_radial, free_tangential = load(u, 0), load(u, LANES)
    radial, tangential = free_radial + load(state.response, 0), free_tangential + load(state.response, LANES)
    free_tilt = tilted = tilt.load_tilt(modal.tilt, u)
    if modal.tilt is not None:
        tilted = free_tilt + load(state.response, 2 * LANES)
    free = free_radial, free_tangential, free_tilt
    geometry = _geometry(tip, radial, tangential, travel)
    approach = loaded_approach = geometry.approach
    linear = _invalid(approach, tilted)
    converged = False
    loaded_tilt = tilted
    tried = not stator.is_rigid and is_within_limit(tip, radial, tangential)
    if tried:
        for _ in range(MAX_ITERATIONS):
            change = absolute(approach - linear.approach)
            if modal.tilt is not None:
                change = change + edge(tip) * absolute(tilted - linear.tilted)
            if not all_lanes(change <= linear.valid):
                linear = _linearise(modal, stator, tip, state, geometry, approach, tilted)
            radial, tangential, loaded_tilt = _displace(
                modal, stator, tip, state, geometry, linear, approach, tilted, free, coulomb
            )
            more_radial, more_tangential = radial - geometry.radial, tangential - geometry.tangential
            loaded_approach = (
                geometry.approach
                + geometry.normal_radial * more_radial
                + geometry.normal_tangential * more_tangential
            )
            residual = approach - loaded_approach
            tilt_residual = tilted - loaded_tilt
            is_straight = all_lanes(absolute(more_tangential) <= STRAIGHT)
            error = absolute(residual)
            if modal.tilt is not None:
                error = error + edge(tip) * absolute(tilt_residual)
            if is_straight and all_lanes(error <= TOLERANCE):
                converged = True
                break
            approach = approach - residual / (1.0 + load(stator.self_compliance, 0) * linear.stiffness)
            if modal.tilt is not None:
                tilt_compliance = load(stator.tilt_compliance, 0)
                tilted = tilted - tilt_residual / (1.0 + tilt_compliance * linear.second_moment)
            if not is_straight:
                if not is_within_limit(tip, radial, tangential):
                    break
                geometry = _geometry(tip, radial, tangential, travel)
                linear = _invalid(approach, tilted)
    if converged:
        store(u, 0, radial)
        store(u, LANES, tangential)
        store(u, 2 * LANES, loaded_approach)
        tilt.store_tilt(modal.tilt, u, loaded_tilt)
    else:
        if tried:  # the iteration may have gone anywhere: begin again without forces
            clear(state.force, 3 * LANES)
            clear(state.normal_force, LANES)
        else:
            store(u, 0, radial)
            store(u, LANES, tangential)
            tilt.store_tilt(modal.tilt, u, tilted)
        radial, tangential = _by_sweeps(modal, stator, tip, travel, state, u)
    store(state.response, 0, radial - free_radial)
    store(state.response, LANES, tangential - free_tangential)
    if modal.tilt is not None:
        store(state.response, 2 * LANES, tilt.load_tilt(modal.tilt, u) - free_tilt)
    return is_within_limit(tip, radial, tangential)


@inlined
def _geometry(tip, radial, tangential, travel):
    approach = normal_approach(tip, radial, tangential)
    normal_radial, normal_tangential = normal(tip, radial, tangential, approach)
    position = closest_position(tip, tangential, travel)
    rows = elements.rows_under(tip, position, position)
    return Geometry(radial, tangential, approach, normal_radial, normal_tangential, position, rows)


@inlined
def _invalid(approach, tilted):
    zero = broadcast(0.0)
    return Linearisation(approach, tilted, zero, zero, broadcast(-1.0), zero, zero, zero)


@inlined
def _linearise(modal, stator, tip, state, geometry, approach, tilted):
    terms = elements.linearise(
        modal.tilt, stator, tip, state, geometry.position, geometry.rows, approach, tilted
    )
    return Linearisation(approach, tilted, *terms)


@inlined
def _displace(modal, stator, tip, state, geometry, linear, approach, tilted, free, coulomb):
    """Put the forces of the elements at `approach` on the blade; return the displacement under them."""
    closer, turned = approach - linear.approach, tilted - linear.tilted
    normal_force = linear.force + linear.stiffness * closer
    if modal.tilt is not None:
        normal_force = normal_force + linear.first_moment * turned
        couple = linear.couple + linear.first_moment * closer + linear.second_moment * turned
        store(state.force, tilt.COUPLE, stator.normal_factor * couple)
    store(state.normal_force, 0, normal_force)
    if coulomb:
        mobilise(modal, stator, tip, state, geometry.normal_radial, geometry.normal_tangential, approach)
        factor = load(state.tangential_factor, 0)
    else:
        factor = broadcast(stator.tangential_factor)
    by_radial, by_tangential = contact_force(
        stator.normal_factor, factor, geometry.normal_radial, geometry.normal_tangential, normal_force
    )
    store(state.force, 0, by_radial)
    store(state.force, LANES, by_tangential)
    return displaced(modal.tilt, modal.compliance, state.force, *free)


@inlined
def _by_sweeps(modal, stator, tip, travel, state, u):
    """Find the forces node by node, from those in `state`; count how often, and how that ends."""
    converged = gauss_seidel(modal, stator, tip, state, travel, u, TOLERANCE)
    if not stator.is_rigid:
        add_to_number(state.ledger, FALLBACK * LANES, 1.0)
    if not converged:
        add_to_number(state.ledger, UNCONVERGED * LANES, 1.0)
    radial, tangential = load(u, 0), load(u, LANES)
    store(u, 2 * LANES, normal_approach(tip, radial, tangential))
    return radial, tangential
