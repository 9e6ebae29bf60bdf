"""The time loop: prediction without contact, contact forces at the prediction, correction.

Pure functions on plain arrays, compiled with numba; no input or output.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.blade.model import N_INTERFACE
from bladerub.contact.coating import return_mapping
from bladerub.contact.machine_code import njit_on_disk
from bladerub.contact.tip import covered, drop

FREE, TOUCHING, OUT_OF_BOUNDS = 0, 1, 2
FAST = {"reassoc", "contract", "arcp", "nsz"}  # sums may be reordered; NaN and infinity stay what they are


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
        N/m, N/m and N of one bar under each node, for `return_mapping`.
    radial, tangential : float
        Direction of the force on the blade, −cos θ and −sin θ.
    """

    gap: np.ndarray
    lowest_gap: np.ndarray
    floor: np.ndarray
    elastic: np.ndarray
    hardening: np.ndarray
    strength: np.ndarray
    radial: float
    tangential: float


class Tip(NamedTuple):
    """Where the interface nodes are, in element widths, and the profile they carry.

    Parameters
    ----------
    start : (8,) ndarray
        Position of each node at the start of a revolution, in elements, within [0, N).
    per_metre : (8,) ndarray
        Elements per metre of tangential displacement.
    radius : (8,) ndarray
        Radius of each node, m.
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
    wear : (8, N) ndarray
        Permanent shortening of the bars, m.
    work : (4,) ndarray
        Radial work, tangential work, damping loss up to the step before, wear loss so far, J.
    """

    q: np.ndarray
    u: np.ndarray
    wear: np.ndarray
    work: np.ndarray


@njit(fastmath=FAST)
def _predict(rule, q, q1, q2):
    """Predict the next modal coordinates without contact, in place of the oldest ones `q2`.

    Returns the damping loss of the step before, J: its end is known only now.
    """
    loss = 0.0
    for k in range(q.size):
        change = q[k] - q2[k]
        loss += rule.loss[k] * change * change
        q2[k] = rule.now[k] * q[k] - rule.before[k] * q1[k]
    return loss


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


@njit(inline="always")
def _wrap(index, n_elements):
    """Bring an index or position less than one turn outside into [0, N)."""
    if index >= n_elements:
        return index - n_elements
    if index < 0:
        return index + n_elements
    return index


@njit(fastmath=FAST)
def _press(stator, tip, wear, j, position, rise):
    """Compress the bars under node `j` by a tip that has risen by `rise`; return push (N) and loss (J)."""
    n_elements = wear.shape[1]
    push = 0.0
    wear_loss = 0.0
    first = int(np.ceil(position - tip.half_width)) - 1
    last = int(np.floor(position + tip.half_width))
    for i in range(first, last + 1):
        offset = i + 0.5 - position
        element = _wrap(i, n_elements)
        penetration = rise - drop(offset, tip.half_width, tip.edge_drop) - stator.gap[j, element]
        worn = wear[j, element]
        force, worn_now = return_mapping(
            penetration, worn, stator.elastic[j], stator.hardening[j], stator.strength[j]
        )
        share = covered(offset, tip.half_width)
        push += share * force
        wear[j, element] = worn_now
        mean_strength = stator.strength[j] + 0.5 * stator.hardening[j] * (worn + worn_now)
        wear_loss += share * mean_strength * (worn_now - worn)
    return push, wear_loss


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


@njit(fastmath=FAST)
def _contact_forces(stator, tip, passed, u, wear, force):
    """Contact forces on the blade at the tip displacement `u`, with the wear they cause.

    Returns
    -------
    outcome : int
        `FREE`, `TOUCHING` or, with the displacement past its limit or not a number, `OUT_OF_BOUNDS`.
    wear_loss : float
        Energy taken by wear, J.
    """
    if not _is_within_bounds(tip, u):  # before any bar is touched
        return OUT_OF_BOUNDS, 0.0
    n_elements = wear.shape[1]
    outcome = FREE
    wear_loss = 0.0
    for j in range(N_INTERFACE):
        radial, tangential = u[j], u[N_INTERFACE + j]
        force[j] = 0.0
        force[N_INTERFACE + j] = 0.0
        position = tip.start[j] + passed + tangential * tip.per_metre[j]
        position = _wrap(_wrap(position, n_elements), n_elements)
        lowest = stator.lowest_gap[j, int(position)]
        if radial + tangential * tangential / tip.radius[j] <= lowest:  # more than the tip can rise
            continue
        # Clearance closes by tangential vibration too: the radius is that of the moved node, to the
        # cosine of the cone where the flow path is one.
        rise = np.sqrt((tip.radius[j] + radial) ** 2 + tangential**2) - tip.radius[j]
        push, loss = _press(stator, tip, wear, j, position, rise)
        if push > 0.0:
            outcome = TOUCHING
            wear_loss += loss
            force[j] = stator.radial * push
            force[N_INTERFACE + j] = stator.tangential * push
    return outcome, wear_loss


@njit(fastmath=FAST)
def _correct(rule, force, q, u):
    """Correct the predicted modal coordinates and tip displacement by the contact forces."""
    for j in range(N_INTERFACE):
        radial, tangential = force[j], force[N_INTERFACE + j]
        if radial == 0.0:
            continue
        for k in range(q.size):
            q[k] += rule.response[j, k] * radial + rule.response[N_INTERFACE + j, k] * tangential
        for i in range(2 * N_INTERFACE):
            u[i] += rule.compliance[j, i] * radial + rule.compliance[N_INTERFACE + j, i] * tangential


@njit(fastmath=FAST)
def _work(force, u_new, u_old):
    """Radial and tangential work of the forces over the two steps around them, halved, J."""
    radial = 0.0
    tangential = 0.0
    for j in range(N_INTERFACE):
        radial += force[j] * (u_new[j] - u_old[j])
        tangential += force[N_INTERFACE + j] * (u_new[N_INTERFACE + j] - u_old[N_INTERFACE + j])
    return 0.5 * radial, 0.5 * tangential


@njit_on_disk(fastmath=FAST)
def revolve(rule, stator, tip, state, steps_per_element, displacement):
    """March one revolution of constant speed; `state` is moved on.

    Parameters
    ----------
    rule : Recurrence
        The free motion of the modes and their response to tip forces.
    stator : Stator
        Coating and casing.
    tip : Tip
        Interface nodes.
    state : State
        Motion, wear and work; changed in place.
    steps_per_element : int
        Time steps in the passage of one element.
    displacement : (N,) ndarray
        Filled with the radial displacement of node 1, mean over the passage of each element, m.

    Returns
    -------
    n_steps, n_contact_steps : int
        Steps made and those with contact; fewer steps than asked for when the tip left all bounds.
    peak : float
        Largest absolute radial displacement of node 1, m.
    """
    n_steps = 0
    n_contact = 0
    peak = 0.0
    now, before, oldest = 0, 1, 2
    force = np.zeros(2 * N_INTERFACE)
    for element in range(displacement.size):
        total = 0.0
        for step in range(steps_per_element):
            q, u = state.q[oldest], state.u[oldest]
            state.work[2] += _predict(rule, state.q[now], state.q[before], q)
            _project(rule.tip, q, u)
            outcome = FREE
            if not _is_clear(tip, u, stator.floor[element]):
                passed = element + (step + 1) / steps_per_element
                outcome, wear_loss = _contact_forces(stator, tip, passed, u, state.wear, force)
            if outcome == OUT_OF_BOUNDS:
                state.q[oldest] = state.q[now]  # the damping loss is complete up to here
                _restore_order(state, now, before, oldest)
                return n_steps, n_contact, peak
            if outcome == TOUCHING:
                _correct(rule, force, q, u)
                radial, tangential = _work(force, u, state.u[before])
                state.work[0] += radial
                state.work[1] += tangential
                state.work[3] += wear_loss
                n_contact += 1
            total += u[0]
            peak = max(peak, abs(u[0]))
            n_steps += 1
            now, before, oldest = oldest, now, before
        displacement[element] = total / steps_per_element
    _restore_order(state, now, before, oldest)
    return n_steps, n_contact, peak


@njit
def _restore_order(state, now, before, oldest):
    """Put the rows of the state back in the order now, before, oldest."""
    for rows in (state.q, state.u):
        ordered = np.vstack((rows[now : now + 1], rows[before : before + 1], rows[oldest : oldest + 1]))
        rows[:] = ordered
