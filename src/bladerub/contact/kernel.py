"""The time loop, by the contract of `bladerub.contact.schemes`: advance the modes, project, meet the casing.

Pure functions on plain arrays, compiled with numba; no input or output.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.blade.model import N_INTERFACE
from bladerub.contact import abradable, rigid
from bladerub.contact.abradable import FAST, wrap
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

SETTLED = 1e-11
"""Change of any node's height in a sweep over all nodes at which the forces are taken as found, m."""
SWEEPS = 200


class Stator(NamedTuple):
    """Coating and casing as the blade tip meets them.

    Parameters
    ----------
    gap : (8, N) ndarray
        Distance from the resting tip to the original surface of each element, eq. (8), m.
    lowest_gap : (8, N) ndarray
        Smallest gap of the elements that a node standing over this one may touch, m.
    floor : (N,) ndarray
        By elements passed since the start of the revolution: the smallest of all gaps that any node
        may meet then, if none moves further than `Tip.stray` along the casing, m.
    elastic, hardening, strength : (8,) ndarray
        N/m, N/m and N of one bar under each node, for `bladerub.contact.coating.return_mapping`.
    is_rigid : bool
        Whether the tip meets the casing itself instead of bars.
    radial, tangential : float
        Direction of the force on a node of the blade that has not moved, −cos θ and −sin θ.
    own_compliance : (8,) ndarray
        Retreat of each node per unit of its own contact force, as the law of contact sees it, m/N.
    """

    gap: np.ndarray
    lowest_gap: np.ndarray
    floor: np.ndarray
    elastic: np.ndarray
    hardening: np.ndarray
    strength: np.ndarray
    is_rigid: bool
    radial: float
    tangential: float
    own_compliance: np.ndarray


class Tip(NamedTuple):
    """Where the interface nodes are, in element widths, and the profile they carry.

    Parameters
    ----------
    start : (8,) ndarray
        Position of each node at the start of a revolution, in elements, within [0, N).
    per_metre : (8,) ndarray
        Elements per metre of tangential displacement.
    radius : (8,) ndarray
        Radius of curvature of the path of each node along the casing, m.
    lever : (8,) ndarray
        Distance of each node from the axis of rotation, m.
    half_width, edge_drop : float
        Of the profile, elements and m.
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
    edge_drop: float
    stray: float
    limit: float


class State(NamedTuple):
    """All that changes during a run.

    Parameters
    ----------
    q : (3, n) ndarray
        Modal coordinates now, one and two steps before.
    u : (3, 16) ndarray
        Displacement of the tip at the same times, m.
    force : (2, 16) ndarray
        Contact forces on the blade now and one step before, N.
    push, moment : (8,) ndarray
        Of each node now: size of the contact force (N) and its moment about the axis (N m).
    wear : (8, N) ndarray
        Permanent shortening of the bars, m.
    ledger : (12,) ndarray
        Entries of `bladerub.contact.ledger`.
    """

    q: np.ndarray
    u: np.ndarray
    force: np.ndarray
    push: np.ndarray
    moment: np.ndarray
    wear: np.ndarray
    ledger: np.ndarray


def at_rest(n_modes: int, n_elements: int) -> State:
    """State of a blade at rest before an unworn coating."""
    return State(
        q=np.zeros((3, n_modes)),
        u=np.zeros((3, 2 * N_INTERFACE)),
        force=np.zeros((2, 2 * N_INTERFACE)),
        push=np.zeros(N_INTERFACE),
        moment=np.zeros(N_INTERFACE),
        wear=np.zeros((N_INTERFACE, n_elements)),
        ledger=np.zeros(N_ENTRIES),
    )


@njit(fastmath=FAST)
def _advance(rule, q, q1, q2):
    """Move the modes freely by one step, in place of the oldest coordinates `q2`.

    Returns the damping loss of the step before, J: its end is known only now.
    """
    loss = 0.0
    for k in range(q.size):
        change = q[k] - q2[k]
        loss += rule.loss[k] * change * change
        q2[k] = rule.now[k] * q[k] - rule.before[k] * q1[k]
    return loss


@njit(fastmath=FAST)
def _respond(response, force, x):
    """Add to `x` (n,) what the contact forces cause, `response` (16, n) per unit of each."""
    for j in range(N_INTERFACE):
        radial, tangential = force[j], force[N_INTERFACE + j]
        if radial == 0.0:
            continue
        for k in range(x.size):
            x[k] += response[j, k] * radial + response[N_INTERFACE + j, k] * tangential


@njit(fastmath=FAST)
def _project(tip_modes, q, u):
    """Displacement of the tip from modal coordinates, the interface rows of eq. (6)."""
    for i in range(0, 2 * N_INTERFACE, 4):
        u0 = u1 = u2 = u3 = 0.0
        for k in range(q.size):
            u0 += tip_modes[i, k] * q[k]
            u1 += tip_modes[i + 1, k] * q[k]
            u2 += tip_modes[i + 2, k] * q[k]
            u3 += tip_modes[i + 3, k] * q[k]
        u[i], u[i + 1], u[i + 2], u[i + 3] = u0, u1, u2, u3


@njit(fastmath=FAST)
def _is_clear(tip, u, floor):
    """Whether the tip surely touches nothing: its highest node is below the lowest gap in reach."""
    highest = -np.inf
    lowest = np.inf
    furthest = 0.0
    for j in range(N_INTERFACE):
        tangential = u[N_INTERFACE + j]
        highest = max(highest, u[j] + tangential * tangential / tip.radius[j])
        lowest = min(lowest, u[j])
        furthest = max(furthest, abs(tangential))
    return highest <= floor and lowest > -tip.limit and furthest <= tip.stray


@njit(fastmath=FAST)
def _is_within_bounds(tip, u):
    """Whether every displacement is a number below the limit."""
    within = True
    for i in range(2 * N_INTERFACE):
        within &= abs(u[i]) < tip.limit
    return within


@njit(inline="always")
def _rise(tip, u, j):
    """Height of node `j` above its place at rest: tangential vibration closes the clearance too, m."""
    tangential = u[N_INTERFACE + j]
    return np.sqrt((tip.radius[j] + u[j]) ** 2 + tangential * tangential) - tip.radius[j]


@njit(inline="always")
def _position(tip, u, j, passed, n_elements):
    """Position of node `j` along the casing in elements, within [0, N)."""
    position = tip.start[j] + passed + u[N_INTERFACE + j] * tip.per_metre[j]
    return wrap(wrap(position, n_elements), n_elements)


@njit(fastmath=FAST)
def _find_forces(rule, stator, tip, passed, state, u):
    """Find the contact forces that agree with the displacement they cause, by Gauss-Seidel sweeps.

    `u` comes as the displacement under the forces of the step before and leaves under the present ones.
    Returns whether it stayed within bounds.
    """
    n_elements = state.wear.shape[1]
    force = state.force[0]
    for _ in range(SWEEPS):
        change = 0.0
        for j in range(N_INTERFACE):
            own = stator.own_compliance[j]
            rise = _rise(tip, u, j)
            free_rise = rise + own * state.push[j]
            position = _position(tip, u, j, passed, n_elements)
            push = 0.0
            if free_rise > stator.lowest_gap[j, int(position)]:
                if stator.is_rigid:
                    push = rigid.push_of(stator.gap, j, position, free_rise, own)
                else:
                    push = abradable.push_of(
                        stator, tip, state.wear, j, position, free_rise, own, state.push[j]
                    )
            if push == 0.0 and state.push[j] == 0.0:
                continue
            change = max(change, own * abs(push - state.push[j]))
            # normal and tangential to the casing where the node is now, which has moved along it
            cosine = (tip.radius[j] + u[j]) / (tip.radius[j] + rise)
            sine = u[N_INTERFACE + j] / (tip.radius[j] + rise)
            radial = push * (stator.radial * cosine - stator.tangential * sine)
            tangential = push * (stator.radial * sine + stator.tangential * cosine)
            by_radial, by_tangential = radial - force[j], tangential - force[N_INTERFACE + j]
            for i in range(2 * N_INTERFACE):
                u[i] += rule.compliance[j, i] * by_radial
                u[i] += rule.compliance[N_INTERFACE + j, i] * by_tangential
            force[j], force[N_INTERFACE + j] = radial, tangential
            state.push[j] = push
        if not _is_within_bounds(tip, u):
            return False
        if change <= SETTLED:
            break
    return True


@njit(fastmath=FAST)
def _settle(stator, tip, passed, per_step, state, push_before, u, u_before):
    """Wear the coating by the forces just found and enter that in the ledger; tell whether any force acts."""
    n_elements = state.wear.shape[1]
    touching = False
    stored = 0.0
    loss = 0.0
    supplied = 0.0
    exchanged = 0.0
    for j in range(N_INTERFACE):
        push = state.push[j]
        state.moment[j] = 0.0
        if push == 0.0 and push_before[j] == 0.0:
            continue
        touching |= push > 0.0
        position = _position(tip, u, j, passed, n_elements)
        along = (u[N_INTERFACE + j] - u_before[N_INTERFACE + j]) * tip.per_metre[j]
        position_before = position - per_step - along
        rise, rise_before = _rise(tip, u, j), _rise(tip, u_before, j)
        if stator.is_rigid:
            ahead = rigid.surface(stator.gap, j, position)
            behind = rigid.surface(stator.gap, j, wrap(position_before, n_elements))
            by_rotation = 0.5 * (push + push_before[j]) * (behind - ahead)
        else:
            in_bars, taken, by_rotation = abradable.settle(
                stator, tip, state.wear, j, position, rise, position_before, rise_before
            )
            stored += in_bars
            loss += taken
        supplied += by_rotation
        exchanged += abs(by_rotation)
        state.moment[j] = -stator.tangential * push * (tip.lever[j] + rise)
    entry = state.ledger
    entry[STORED_BEFORE] = entry[STORED]
    entry[STORED] = stored
    entry[LAST_WEAR] = loss
    entry[LAST_SHAPE] = supplied
    entry[WEAR] += loss
    entry[SHAPE] += supplied
    entry[EXCHANGED] += exchanged
    return touching


@njit(fastmath=FAST)
def _enter_work(tip, state, force, push, moment, u_new, u_old):
    """Enter the work of one step's forces, over half of the way from the step before to the step after."""
    entry = state.ledger
    for j in range(N_INTERFACE):
        if push[j] == 0.0:
            continue
        radial = force[j] * 0.5 * (u_new[j] - u_old[j])
        tangential = force[N_INTERFACE + j] * 0.5 * (u_new[N_INTERFACE + j] - u_old[N_INTERFACE + j])
        entry[RADIAL] += radial
        entry[TANGENTIAL] += tangential
        entry[EXCHANGED] += abs(radial) + abs(tangential)
        entry[NORMAL] += push[j] * 0.5 * (_rise(tip, u_new, j) - _rise(tip, u_old, j))
        entry[TORQUE] += moment[j]


@njit_on_disk(fastmath=FAST)
def revolve(rule, stator, tip, state, steps_per_element, displacement):
    """March one revolution of constant speed; `state` is moved on.

    Parameters
    ----------
    rule : Recurrence
        The scheme.
    stator : Stator
        Coating and casing.
    tip : Tip
        Interface nodes.
    state : State
        Motion, forces, wear and ledger; changed in place.
    steps_per_element : int
        Time steps in the passage of one element.
    displacement : (N,) ndarray
        Filled with the radial displacement of node 1, mean over the passage of each element, m.

    Returns
    -------
    n_steps, n_contact_steps : int
        Steps made and those with contact; fewer steps than asked for when the tip left all bounds.
    lowest, highest : float
        Range of the radial displacement of node 1, m.
    """
    n_steps = 0
    n_contact = 0
    lowest = np.inf
    highest = -np.inf
    per_step = 1.0 / steps_per_element
    touching = state.push.max() > 0.0
    push, moment = np.zeros(N_INTERFACE), np.zeros(N_INTERFACE)
    now, before, oldest = 0, 1, 2
    for element in range(displacement.size):
        total = 0.0
        for step in range(steps_per_element):
            q, u = state.q[oldest], state.u[oldest]
            touched = touching
            if touched:
                state.force[1] = state.force[0]
                push[:], moment[:] = state.push, state.moment
            state.ledger[DAMPING] += _advance(rule, state.q[now], state.q[before], q)
            if touched and not rule.corrects:
                _respond(rule.push, state.force[1], q)
            _project(rule.tip, q, u)
            clear = _is_clear(tip, u, stator.floor[element])
            if touched or not clear:
                passed = element + (step + 1) * per_step
                within = True
                if clear:
                    state.force[0] = 0.0
                    state.push[:] = 0.0
                else:
                    _respond(rule.compliance, state.force[0], u)
                    within = _is_within_bounds(tip, u) and _find_forces(rule, stator, tip, passed, state, u)
                if not within:
                    state.q[oldest] = state.q[now]  # the damping loss is complete up to here
                    state.force[0] = state.force[1]
                    _restore_order(state, now, before, oldest)
                    return n_steps, n_contact, lowest, highest
                touching = _settle(stator, tip, passed, per_step, state, push, u, state.u[now])
                if touching and rule.corrects:
                    _respond(rule.push, state.force[0], q)
                    _project(rule.tip, q, u)
                if touched:
                    _enter_work(tip, state, state.force[1], push, moment, u, state.u[before])
                    push[:] = 0.0
                n_contact += touching
            total += 0.5 * (state.u[now, 0] + u[0])
            lowest = min(lowest, u[0])
            highest = max(highest, u[0])
            n_steps += 1
            now, before, oldest = oldest, now, before
        displacement[element] = total * per_step
    _restore_order(state, now, before, oldest)
    return n_steps, n_contact, lowest, highest


@njit
def _restore_order(state, now, before, oldest):
    """Put the rows of the state back in the order now, before, oldest."""
    for rows in (state.q, state.u):
        ordered = np.vstack((rows[now : now + 1], rows[before : before + 1], rows[oldest : oldest + 1]))
        rows[:] = ordered
