"""The time loop, by the contract of `bladerub.contact.schemes`: advance the modes, project, meet the casing.

Pure functions on plain arrays, compiled with numba; no input or output.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.contact import abradable, rigid
from bladerub.contact.geometry import force_of, is_within_bounds, position_of, rise_of
from bladerub.contact.ledger import (
    DAMPING,
    EXCHANGED,
    LAST_SHAPE,
    LAST_WEAR,
    N_ENTRIES,
    NORMAL,
    RADIAL,
    SHAPE,
    STORED,
    STORED_BEFORE,
    TANGENTIAL,
    TORQUE,
    WEAR,
)
from bladerub.contact.machine_code import njit_on_disk
from bladerub.contact.motion import advance, push_modes, respond
from bladerub.contact.relaxation import relax
from bladerub.contact.vectors import (
    LANES,
    addresses,
    aligned,
    at,
    choose,
    everywhere,
    highest,
    load,
    magnitude,
    read,
    splat,
    store,
    write,
)

SETTLED = 1e-11
"""Imbalance of any node's height at which the contact forces are taken as found, m."""
ATTEMPTS = 8
"""Steps of Newton's method before the forces are sought node by node."""
NEGLIGIBLE = 1e-100
"""Modal coordinates below this are zero, m kg^1/2: numbers too small to be normal would slow the loop."""


class Stator(NamedTuple):
    """Coating and casing as the blade tip meets them, in rows of elements.

    Row r has for each node the element r past the one the node stands over at the start of a revolution.

    Parameters
    ----------
    gap : (N, 8) ndarray
        Distance from the resting tip to the original surface of each element, eq. (8), m.
    floor : (N,) ndarray
        By elements passed since the start of the revolution: the smallest of all gaps that any node
        may meet then, if none moves further than `Tip.stray` along the casing, m.
    elastic, hardening, strength : (8,) ndarray
        N/m, N/m and N of one bar under each node, for `bladerub.contact.coating.return_mapping`.
    yielding, softness : (8,) ndarray
        Compliance of one bar that yields, without its elastic part, and half of the elastic one, m/N.
    n_elements : int
        N.
    is_rigid : bool
        Whether the tip meets the casing itself instead of bars.
    radial, tangential : float
        Direction of the force on a node of the blade that has not moved, −cos θ and −sin θ.
    own_compliance : (8,) ndarray
        Retreat of each node per unit of its own contact force, as the law of contact sees it, m/N.
    """

    gap: np.ndarray
    floor: np.ndarray
    elastic: np.ndarray
    hardening: np.ndarray
    strength: np.ndarray
    yielding: np.ndarray
    softness: np.ndarray
    n_elements: int
    is_rigid: bool
    radial: float
    tangential: float
    own_compliance: np.ndarray


class Tip(NamedTuple):
    """Where the interface nodes are, in element widths, and the profile they carry.

    Parameters
    ----------
    start : (8,) ndarray
        Position of each node at the start of a revolution, in rows, within [0, 1).
    per_metre : (8,) ndarray
        Elements per metre of tangential displacement.
    radius : (8,) ndarray
        Radius of curvature of the path of each node along the casing, m.
    lever : (8,) ndarray
        Distance of each node from the axis of rotation, m.
    half_width : float
        Of the profile, elements.
    drop : float
        Of the profile, one element from its middle, m.
    stray : float
        Tangential displacement up to which `Stator.floor` holds, m.
    limit : float
        Displacement beyond which the run is unbounded, m.
    """

    start: np.ndarray
    per_metre: np.ndarray
    radius: np.ndarray
    lever: np.ndarray
    half_width: float
    drop: float
    stray: float
    limit: float


class State(NamedTuple):
    """All that changes during a run.

    Parameters
    ----------
    q : (3, n) ndarray
        Modal coordinates now, one and two steps before, padded with zeros to whole vectors.
    u : (3, 24) ndarray
        Radial and tangential displacement of the tip at the same times, and the height of its nodes, m.
    force : (2, 16) ndarray
        Contact forces on the blade now and one step before, N.
    push, moment : (2, 8) ndarray
        Of each node at the same times: size of the contact force (N) and its moment about the axis (N m).
    wear : (N, 8) ndarray
        Permanent shortening of the bars, in the rows of `Stator`, m.
    ledger : (12, 8) ndarray
        Entries of `bladerub.contact.ledger`, to be summed over the nodes.
    scratch : (4, 16) ndarray
        Of no meaning between steps.
    """

    q: np.ndarray
    u: np.ndarray
    force: np.ndarray
    push: np.ndarray
    moment: np.ndarray
    wear: np.ndarray
    ledger: np.ndarray
    scratch: np.ndarray


def at_rest(n_modes: int, n_elements: int) -> State:
    """State of a blade at rest before an unworn coating."""
    state = State(
        q=np.zeros((3, n_modes + -n_modes % LANES)),
        u=np.zeros((3, 3 * LANES)),
        force=np.zeros((2, 2 * LANES)),
        push=np.zeros((2, LANES)),
        moment=np.zeros((2, LANES)),
        wear=np.zeros((n_elements, LANES)),
        ledger=np.zeros((N_ENTRIES, LANES)),
        scratch=np.zeros((4, 2 * LANES)),
    )
    return aligned(state)


@njit
def _put(tip, radial, tangential, u):
    """Store a displacement of the tip and the height of its nodes; return that height."""
    rise = rise_of(tip, radial, tangential)
    store(u, 0, radial)
    store(u, LANES, tangential)
    store(u, 2 * LANES, rise)
    return rise


@njit
def _is_clear(tip, radial, tangential, rise, floor):
    """Whether the tip surely touches nothing: its highest node is below the lowest gap in reach."""
    return everywhere((rise <= floor) & (magnitude(tangential) <= tip.stray) & (radial > -tip.limit))


@njit
def _find_forces(motion, stator, tip, passed, state, u):
    """Find the contact forces that agree with the displacement they cause, by Newton's method.

    `u` comes as the displacement without forces of this step and leaves under them; the forces of the step
    before are the first guess. Returns whether the tip stayed within bounds.
    """
    force, push = state.force, state.push
    free_radial, free_tangential = load(u, 0), load(u, LANES)
    radial, tangential = respond(motion.compliance, force, free_radial, free_tangential)
    rise = met = rise_of(tip, radial, tangential)
    found = False
    if not stator.is_rigid:
        for _ in range(ATTEMPTS):
            if not is_within_bounds(tip, radial, tangential):
                break
            position = position_of(tip, tangential, passed)
            by_coating, stiffness = abradable.push_at(stator, tip, state.wear, position, rise)
            store(push, 0, by_coating)
            by_radial, by_tangential = force_of(stator, tip, radial, tangential, met, by_coating)
            store(force, 0, by_radial)
            store(force, LANES, by_tangential)
            radial, tangential = respond(motion.compliance, force, free_radial, free_tangential)
            met = rise_of(tip, radial, tangential)
            error = rise - met
            if highest(magnitude(error)) <= SETTLED:
                found = True
                break
            rise = rise - error / (1.0 + load(stator.own_compliance, 0) * stiffness)
        if not found:  # it may be anywhere by now: begin again
            _clear(force, 2 * LANES)
            _clear(push, LANES)
            radial, tangential = free_radial, free_tangential
    store(u, 0, radial)
    store(u, LANES, tangential)
    store(u, 2 * LANES, met)
    if not found:
        relax(motion, stator, tip, state, passed, u, SETTLED)
        _put(tip, load(u, 0), load(u, LANES), u)
    return is_within_bounds(tip, load(u, 0), load(u, LANES))


@njit
def _settle(stator, tip, passed, per_step, state, u, u_before):
    """Wear the coating by the forces just found and enter that in the ledger."""
    tangential, tangential_before = load(u, LANES), load(u_before, LANES)
    rise = load(u, 2 * LANES)
    position = position_of(tip, tangential, passed)
    position_before = position_of(tip, tangential_before, passed - per_step)
    push = load(state.push, 0)
    if stator.is_rigid:
        stored, loss = splat(0.0), splat(0.0)
        shape = rigid.surface(stator, position_before) - rigid.surface(stator, position)
        supplied = 0.5 * (push + load(state.push, LANES)) * shape
    else:
        stored, loss, supplied = abradable.settle(
            stator, tip, state.wear, position, rise, position_before, load(u_before, 2 * LANES)
        )
    store(state.moment, 0, -stator.tangential * push * (load(tip.lever, 0) + rise))
    entry = state.ledger
    store(entry, STORED_BEFORE * LANES, load(entry, STORED * LANES))
    store(entry, STORED * LANES, stored)
    store(entry, LAST_WEAR * LANES, loss)
    store(entry, LAST_SHAPE * LANES, supplied)
    _enter(entry, WEAR, loss)
    _enter(entry, SHAPE, supplied)
    _enter(entry, EXCHANGED, magnitude(supplied))


@njit
def _enter_work(state, u_new, u_old):
    """Enter the work of the forces of a step, over half of the way from the step before to the step after."""
    entry = state.ledger
    by_radial = 0.5 * load(state.force, 2 * LANES) * (load(u_new, 0) - load(u_old, 0))
    by_tangential = 0.5 * load(state.force, 3 * LANES) * (load(u_new, LANES) - load(u_old, LANES))
    climb = load(u_new, 2 * LANES) - load(u_old, 2 * LANES)
    _enter(entry, RADIAL, by_radial)
    _enter(entry, TANGENTIAL, by_tangential)
    _enter(entry, EXCHANGED, magnitude(by_radial) + magnitude(by_tangential))
    _enter(entry, NORMAL, 0.5 * load(state.push, LANES) * climb)
    _enter(entry, TORQUE, load(state.moment, LANES))


@njit(inline="always")
def _enter(ledger, entry, amount):
    store(ledger, entry * LANES, load(ledger, entry * LANES) + amount)


@njit(inline="always")
def _copy(source, target, n):
    for k in range(0, n, LANES):
        store(target, k, load(source, k))


@njit(inline="always")
def _clear(target, n):
    for k in range(0, n, LANES):
        store(target, k, splat(0.0))


@njit
def _drop_negligible(q, n):
    for k in range(0, n, LANES):
        x = load(q, k)
        store(q, k, choose(magnitude(x) > NEGLIGIBLE, x, 0.0))


def revolve(motion, stator, tip, state, steps_per_element, displacement):
    """March one revolution of constant speed, or its beginning; `state` is moved on.

    Parameters
    ----------
    motion : bladerub.contact.motion.Motion
        Coefficients of the scheme.
    stator : Stator
        Coating and casing.
    tip : Tip
        Tip of the blade.
    state : State
        Where the run is.
    steps_per_element : int
        Time steps in the passage of one element.
    displacement : (n,) ndarray
        Filled with the radial displacement of node 1, mean over the passage of each element, m; n = N makes
        one revolution.

    Returns
    -------
    n_steps, n_contact_steps : int
        Steps made and those with contact; fewer steps than asked for when the tip left all bounds.
    lowest, highest : float
        Range of the radial displacement of node 1, m.
    """
    parts = (addresses(part) for part in (motion, stator, tip, state))
    made, touched, *extremes = _march(*parts, steps_per_element, displacement.size, displacement.ctypes.data)
    for rows in (state.q, state.u):  # the loop lets the three rows take turns
        rows[:] = np.roll(rows, made % 3, axis=0)
    return made, touched, *extremes


@njit_on_disk()
def _march(motion, stator, tip, state, steps_per_element, n_elements, displacement):
    n_steps = 0
    n_contact = 0
    bottom, top = np.inf, -np.inf
    per_step = 1.0 / steps_per_element
    touched = touching = highest(load(state.push, 0)) > 0.0
    damping = splat(0.0)
    q, q_before, q_next = state.q, at(state.q, motion.n), at(state.q, 2 * motion.n)
    u, u_before, u_next = state.u, at(state.u, 3 * LANES), at(state.u, 6 * LANES)
    force, force_before = state.force, at(state.force, 2 * LANES)
    push_before = at(state.push, LANES)
    for element in range(n_elements):
        _drop_negligible(state.q, 3 * motion.n)
        mean = 0.0
        for step in range(steps_per_element):
            touched = touching
            radial, tangential, loss = advance(motion, q, q_before, q_next)
            damping = damping + loss
            if touched:
                _copy(force, force_before, 2 * LANES)
                _copy(state.push, push_before, LANES)
                _copy(state.moment, at(state.moment, LANES), LANES)
                if not motion.corrects:
                    push_modes(motion, force_before, q_next)
                    radial, tangential = respond(motion.kick, force_before, radial, tangential)
            rise = _put(tip, radial, tangential, u_next)
            clear = _is_clear(tip, radial, tangential, rise, read(stator.floor, element))
            if touched or not clear:
                passed = element + (step + 1) * per_step
                touching = False
                if clear:
                    _clear(force, 2 * LANES)
                    _clear(state.push, LANES)
                else:
                    if not _find_forces(motion, stator, tip, passed, state, u_next):
                        _copy(q, q_next, motion.n)  # the damping loss is complete up to here
                        _copy(force_before, force, 2 * LANES)
                        _enter(state.ledger, DAMPING, damping)
                        return n_steps, n_contact, bottom, top
                    touching = highest(load(state.push, 0)) > 0.0
                if touching or touched:
                    _settle(stator, tip, passed, per_step, state, u_next, u)
                if touching and motion.corrects:
                    push_modes(motion, force, q_next)
                    radial, tangential = respond(motion.kick, force, radial, tangential)
                    _put(tip, radial, tangential, u_next)
                if touched:
                    _enter_work(state, u_next, u_before)
                    _clear(push_before, LANES)
                n_contact += touching
            node_1, node_1_before = read(u_next, 0), read(u, 0)
            mean += 0.5 * (node_1_before + node_1)
            bottom, top = min(bottom, node_1), max(top, node_1)
            n_steps += 1
            q, q_before, q_next = q_next, q, q_before
            u, u_before, u_next = u_next, u, u_before
        write(displacement, element, mean * per_step)
    _enter(state.ledger, DAMPING, damping)
    if not (touched or touching):  # the last step added nothing
        _clear(at(state.ledger, STORED * LANES), 4 * LANES)
    return n_steps, n_contact, bottom, top
