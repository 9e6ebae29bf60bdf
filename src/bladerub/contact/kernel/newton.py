"""Contact forces of a step, by Newton's method on the approach of all nodes at once.

The unknown is the approach a of each node to the casing. The forces N(a) of the elements, which are piecewise
linear, displace the tip from u₀ to ``u₀ + C F(N)``, C the compliance of the scheme. Forces and displacement
agree, eqs. (8) and (9), where the residual ``r(a) = a − n · (u₀ + C F(N(a)))`` vanishes. Normal n, position
and rows of elements are those of a nearby displacement, and are found again when the nodes move along the
casing.
"""

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.contact.energy import FALLBACK, UNCONVERGED
from bladerub.contact.friction import contact_force
from bladerub.contact.gap import closest_position, is_within_limit, normal, normal_approach
from bladerub.contact.kernel import elements
from bladerub.contact.kernel.coulomb import mobilise
from bladerub.contact.kernel.gauss_seidel import gauss_seidel
from bladerub.contact.kernel.modal import displaced
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
    """Force and stiffness of the elements at an approach, and the change of it over which they hold."""

    approach: np.ndarray
    force: np.ndarray
    stiffness: np.ndarray
    valid: np.ndarray


@njit(forceinline=True)
def find_forces(modal, stator, tip, passed, state, u, coulomb):
    """Find the contact forces that agree with the displacement they cause.

    `u` comes as the displacement without forces of this step and leaves under them. The response to the
    forces of the step before is the first guess. `coulomb` is a constant where this is compiled into the
    loop. Returns whether the displacement is within the limit.
    """
    free_radial, free_tangential = load(u, 0), load(u, LANES)
    radial, tangential = free_radial + load(state.response, 0), free_tangential + load(state.response, LANES)
    here = _geometry(tip, radial, tangential, passed)
    approach = reached = here.approach
    linear = Linearisation(approach, approach, approach, broadcast(-1.0))
    converged = False
    tried = not stator.is_rigid and is_within_limit(tip, radial, tangential)
    if tried:
        for _ in range(MAX_ITERATIONS):
            if not all_lanes(absolute(approach - linear.approach) <= linear.valid):
                linear = _linearise(stator, tip, state, here, approach)
            radial, tangential = _displace(
                modal, stator, tip, state, here, linear, approach, free_radial, free_tangential, coulomb
            )
            more_radial, more_tangential = radial - here.radial, tangential - here.tangential
            reached = (
                here.approach + here.normal_radial * more_radial + here.normal_tangential * more_tangential
            )
            residual = approach - reached
            is_straight = all_lanes(absolute(more_tangential) <= STRAIGHT)
            if is_straight and all_lanes(absolute(residual) <= TOLERANCE):
                converged = True
                break
            approach = approach - residual / (1.0 + load(stator.self_compliance, 0) * linear.stiffness)
            if not is_straight:
                if not is_within_limit(tip, radial, tangential):
                    break
                here = _geometry(tip, radial, tangential, passed)
                linear = Linearisation(linear.approach, linear.force, linear.stiffness, broadcast(-1.0))
    if converged:
        store(u, 0, radial)
        store(u, LANES, tangential)
        store(u, 2 * LANES, reached)
    else:
        if tried:  # the iteration may have gone anywhere: begin again without forces
            clear(state.force, 2 * LANES)
            clear(state.normal_force, LANES)
        else:
            store(u, 0, radial)
            store(u, LANES, tangential)
        radial, tangential = _by_sweeps(modal, stator, tip, passed, state, u)
    store(state.response, 0, radial - free_radial)
    store(state.response, LANES, tangential - free_tangential)
    return is_within_limit(tip, radial, tangential)


@njit(forceinline=True)
def _geometry(tip, radial, tangential, passed):
    approach = normal_approach(tip, radial, tangential)
    normal_radial, normal_tangential = normal(tip, radial, tangential, approach)
    position = closest_position(tip, tangential, passed)
    rows = elements.rows_under(tip, position, position)
    return Geometry(radial, tangential, approach, normal_radial, normal_tangential, position, rows)


@njit(forceinline=True)
def _linearise(stator, tip, state, here, approach):
    force, stiffness, valid = elements.linearise(stator, tip, state.wear, here.position, here.rows, approach)
    return Linearisation(approach, force, stiffness, valid)


@njit(forceinline=True)
def _displace(modal, stator, tip, state, here, linear, approach, free_radial, free_tangential, coulomb):
    """Put the forces of the elements at `approach` on the blade; return the displacement under them."""
    normal_force = linear.force + linear.stiffness * (approach - linear.approach)
    store(state.normal_force, 0, normal_force)
    if coulomb:
        mobilise(modal, stator, tip, state, here.normal_radial, here.normal_tangential, approach)
        factor = load(state.tangential_factor, 0)
    else:
        factor = broadcast(stator.tangential_factor)
    by_radial, by_tangential = contact_force(
        stator.normal_factor, factor, here.normal_radial, here.normal_tangential, normal_force
    )
    store(state.force, 0, by_radial)
    store(state.force, LANES, by_tangential)
    return displaced(modal.compliance, state.force, free_radial, free_tangential)


@njit(forceinline=True)
def _by_sweeps(modal, stator, tip, passed, state, u):
    """Find the forces node by node, from those in `state`; count how often, and how that ends."""
    converged = gauss_seidel(modal, stator, tip, state, passed, u, TOLERANCE)
    if not stator.is_rigid:
        add_to_number(state.ledger, FALLBACK * LANES, 1.0)
    if not converged:
        add_to_number(state.ledger, UNCONVERGED * LANES, 1.0)
    radial, tangential = load(u, 0), load(u, LANES)
    store(u, 2 * LANES, normal_approach(tip, radial, tangential))
    return radial, tangential
