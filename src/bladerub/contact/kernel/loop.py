"""The time loop, by the contract of `bladerub.contact.schemes`: advance the modes, project, meet the casing.

Compiled functions on the addresses of the arrays of five records, which `Rub` keeps; no input or output.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numba import njit

from bladerub.contact import friction
from bladerub.contact.energy import (
    DAMPING,
    EXCHANGED,
    LAST_SHAPE,
    LAST_WEAR,
    N_ENTRIES,
    NORMAL,
    RADIAL,
    RETREAT,
    REVERSED,
    SHAPE,
    STORED,
    STORED_BEFORE,
    TANGENTIAL,
    TORQUE,
    WEAR,
)
from bladerub.contact.gap import force_of, is_within_bounds, normal_of, position_of, rise_of
from bladerub.contact.kernel import abradable, free_flight, rigid
from bladerub.contact.kernel.free_flight import Leap
from bladerub.contact.kernel.gauss_seidel import relax
from bladerub.contact.kernel.machine_code import njit_on_disk
from bladerub.contact.kernel.modal import Motion, advance, advance_under, push_modes, respond
from bladerub.contact.kernel.vectors import (
    LANES,
    absolute,
    address_of,
    addresses,
    aligned,
    all_lanes,
    broadcast,
    largest_lane,
    load,
    maximum,
    read,
    store,
    where,
    write,
)

SETTLED = 1e-11
"""Imbalance of any node's height at which the contact forces are taken as found, m."""
NEAR = 1e-8
"""Way along the casing that the search for the forces takes as straight and over the same bars, m."""
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
    law : (5, 8) ndarray
        `bladerub.contact.law.Element` of one element under each node, a row for each parameter.
    n_elements : int
        N.
    is_rigid : bool
        Whether the tip meets the casing itself instead of bars.
    radial, tangential : float
        Direction of the force on a node of the blade that has not moved, −cos θ and −sin θ.
    own_compliance : (8,) ndarray
        Retreat of each node per unit of its own contact force in that direction, as the law of contact sees
        it, m/N.
    reverses : bool
        Whether the tangential part of the force follows the sliding of the node by Coulomb's law.
    """

    gap: np.ndarray
    floor: np.ndarray
    law: np.ndarray
    n_elements: int
    is_rigid: bool
    radial: float
    tangential: float
    own_compliance: np.ndarray
    reverses: bool = False


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
    curvature : float
        Of the profile, m per element width squared.
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
    curvature: float
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
    way : (16,) ndarray
        Displacement of the tip by the forces of the last step in that step: where their search begins, m.
    drift : (24,) ndarray
        Way of the tip over the casing without the forces of this step: radial, tangential and by rotation, m.
    along : (8,) ndarray
        Tangential part of the force on each node: that of the stator, or what friction leaves of it.
    wear : (N, 8) ndarray
        Permanent shortening of the bars, in the rows of `Stator`, m.
    ledger : (14, 8) ndarray
        Entries of `bladerub.contact.energy`, to be summed over the nodes.
    scratch : (5, 16) ndarray
        Of no meaning between steps.
    """

    q: np.ndarray
    u: np.ndarray
    force: np.ndarray
    push: np.ndarray
    moment: np.ndarray
    way: np.ndarray
    drift: np.ndarray
    along: np.ndarray
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
        way=np.zeros(2 * LANES),
        drift=np.zeros(3 * LANES),
        along=np.zeros(LANES),
        wear=np.zeros((n_elements, LANES)),
        ledger=np.zeros((N_ENTRIES, LANES)),
        scratch=np.zeros((5, 2 * LANES)),
    )
    return aligned(state)


@njit(forceinline=True)
def _put(tip, radial, tangential, u):
    """Store a displacement of the tip and the height of its nodes; return that height."""
    rise = rise_of(tip, radial, tangential)
    store(u, 0, radial)
    store(u, LANES, tangential)
    store(u, 2 * LANES, rise)
    return rise


@njit(forceinline=True)
def _is_clear(tip, radial, tangential, rise, floor):
    """Whether the tip surely touches nothing: its highest node is below the lowest gap in reach."""
    return all_lanes((rise <= floor) & (absolute(tangential) <= tip.stray) & (radial > -tip.limit))


@njit(forceinline=True)
def _find_forces(motion, stator, tip, passed, state, u, reverses):
    """Find the contact forces that agree with the displacement they cause, by Newton's method.

    `u` comes as the displacement without forces of this step and leaves under them; what the forces of the
    step before did is the first guess. Returns whether the tip stayed within bounds.
    """
    force, push = state.force, state.push
    free_radial, free_tangential = load(u, 0), load(u, LANES)
    radial, tangential = free_radial + load(state.way, 0), free_tangential + load(state.way, LANES)
    there_radial, there_tangential = radial, tangential
    rise = met = met_there = rise_of(tip, radial, tangential)
    normal_radial, normal_tangential = normal_of(tip, radial, tangential, rise)
    position = position_of(tip, tangential, passed)
    rows = abradable.rows_under(tip, position, position)
    evaluated, push_evaluated, stiffness, margin = rise, rise, rise, broadcast(-1.0)
    found = False
    if not stator.is_rigid and is_within_bounds(tip, radial, tangential):
        for _ in range(ATTEMPTS):
            if not all_lanes(absolute(rise - evaluated) <= margin):
                evaluated = rise
                push_evaluated, stiffness, margin = abradable.push_at(
                    stator, tip, state.wear, position, rows, rise
                )
            by_coating = push_evaluated + stiffness * (rise - evaluated)
            store(push, 0, by_coating)
            if reverses:
                friction.take_hold(motion, stator, tip, state, normal_radial, normal_tangential, rise)
                along = load(state.along, 0)
            else:
                along = broadcast(stator.tangential)
            by_radial, by_tangential = force_of(stator, along, normal_radial, normal_tangential, by_coating)
            store(force, 0, by_radial)
            store(force, LANES, by_tangential)
            radial, tangential = respond(motion.compliance, force, free_radial, free_tangential)
            way_radial, way_tangential = radial - there_radial, tangential - there_tangential
            met = met_there + normal_radial * way_radial + normal_tangential * way_tangential
            error = rise - met
            if all_lanes((absolute(error) <= SETTLED) & (absolute(way_tangential) <= NEAR)):
                found = True
                break
            rise = rise - error / (1.0 + load(stator.own_compliance, 0) * stiffness)
            if not all_lanes(absolute(way_tangential) <= NEAR):
                if not is_within_bounds(tip, radial, tangential):
                    break
                there_radial, there_tangential = radial, tangential
                met_there = rise_of(tip, radial, tangential)
                normal_radial, normal_tangential = normal_of(tip, radial, tangential, met_there)
                position = position_of(tip, tangential, passed)
                rows = abradable.rows_under(tip, position, position)
                margin = broadcast(-1.0)
        if not found:  # it may be anywhere by now: begin again
            _clear(force, 2 * LANES)
            _clear(push, LANES)
            radial, tangential = free_radial, free_tangential
    store(u, 0, radial)
    store(u, LANES, tangential)
    store(u, 2 * LANES, met)
    if not found:
        relax(motion, stator, tip, state, passed, u, SETTLED)
        radial, tangential = load(u, 0), load(u, LANES)
        _put(tip, radial, tangential, u)
    store(state.way, 0, radial - free_radial)
    store(state.way, LANES, tangential - free_tangential)
    return is_within_bounds(tip, radial, tangential)


@njit(forceinline=True)
def _settle(stator, tip, passed, per_step, state, u, u_before):
    """Wear the coating by the forces just found and enter that in the ledger."""
    tangential, tangential_before = load(u, LANES), load(u_before, LANES)
    rise = load(u, 2 * LANES)
    position = position_of(tip, tangential, passed)
    position_before = position_of(tip, tangential_before, passed - per_step)
    push, along = load(state.push, 0), load(state.along, 0)
    slid = where(push > 0.0, position - position_before, per_step)
    store(state.ledger, RETREAT * LANES, maximum(load(state.ledger, RETREAT * LANES), per_step - slid))
    withheld = where(push > 0.0, along - stator.tangential, 0.0)
    if not all_lanes((slid > 0.0) & (withheld <= 0.0)):
        write(state.ledger, REVERSED * LANES, read(state.ledger, REVERSED * LANES) + 1.0)
    if stator.is_rigid:
        stored, loss = broadcast(0.0), broadcast(0.0)
        shape = rigid.surface(stator, position_before) - rigid.surface(stator, position)
        supplied = 0.5 * (push + load(state.push, LANES)) * shape
    else:
        stored, loss, supplied = abradable.settle(
            stator, tip, state.wear, position, rise, position_before, load(u_before, 2 * LANES)
        )
    store(state.moment, 0, (0.0 - along) * push * (load(tip.lever, 0) + rise))
    entry = state.ledger
    store(entry, STORED_BEFORE * LANES, load(entry, STORED * LANES))
    store(entry, STORED * LANES, stored)
    store(entry, LAST_WEAR * LANES, loss)
    store(entry, LAST_SHAPE * LANES, supplied)
    _enter(entry, WEAR, loss)
    _enter(entry, SHAPE, supplied)
    _enter(entry, EXCHANGED, absolute(supplied))


@njit(forceinline=True)
def _enter_work(state, u_new, u_old):
    """Enter the work of the forces of a step, over half of the way from the step before to the step after."""
    entry = state.ledger
    by_radial = 0.5 * load(state.force, 2 * LANES) * (load(u_new, 0) - load(u_old, 0))
    by_tangential = 0.5 * load(state.force, 3 * LANES) * (load(u_new, LANES) - load(u_old, LANES))
    climb = load(u_new, 2 * LANES) - load(u_old, 2 * LANES)
    _enter(entry, RADIAL, by_radial)
    _enter(entry, TANGENTIAL, by_tangential)
    _enter(entry, EXCHANGED, absolute(by_radial) + absolute(by_tangential))
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
        store(target, k, broadcast(0.0))


@njit(forceinline=True)
def _drop_negligible(q, n):
    for k in range(0, n, LANES):
        x = load(q, k)
        store(q, k, where(absolute(x) > NEGLIGIBLE, x, 0.0))


class Rub:
    """A blade and a stator, set to be marched.

    Parameters
    ----------
    motion : bladerub.contact.kernel.modal.Motion
        Coefficients of the scheme.
    flight : bladerub.contact.kernel.free_flight.Leap
        The same for free flight over many steps.
    stator : Stator
        Coating and casing.
    tip : Tip
        Tip of the blade.
    state : State
        Where the run is; `revolve` moves it on.
    steps_per_element : int
        Time steps in the passage of one element.
    """

    def __init__(
        self, motion: Motion, flight: Leap, stator: Stator, tip: Tip, state: State, steps_per_element: int
    ):
        self.motion, self.flight, self.stator, self.tip, self.state = motion, flight, stator, tip, state
        self.steps_per_element = steps_per_element
        state.along[:] = stator.tangential  # Coulomb's law finds its own before it is used
        self._records = [addresses(record) for record in (motion, flight, stator, tip, state)]

    @property
    def angle_per_step(self) -> float:
        """Angle by which the blade turns in a step, rad."""
        return 2 * np.pi / (self.steps_per_element * self.stator.n_elements)

    def revolve(self, displacement: np.ndarray, first: int = 0) -> Progress:
        """March one revolution of constant speed, or a part of it.

        Parameters
        ----------
        displacement : (n,) ndarray
            Filled with the radial displacement of node 1, mean over the passage of each element, m; n = N
            makes one revolution.
        first : int, optional
            Elements that have been passed since the start of the revolution.
        """
        last = first + displacement.size
        turns, *made = _march(*self._records, self.steps_per_element, first, last, displacement.ctypes.data)
        for rows in (self.state.q, self.state.u):  # the loop lets the three rows take turns
            rows[:] = rows[(np.arange(3) - turns) % 3]
        return Progress(*made)


class Progress(NamedTuple):
    """What was made of a revolution.

    Parameters
    ----------
    n_steps, n_leaps, n_contact_steps : int
        Steps made, leaps that many of them were made in, and steps with contact; fewer steps than asked for
        when the tip left all bounds.
    lowest, highest : float
        Range of the radial displacement of node 1, m.
    """

    n_steps: int
    n_leaps: int
    n_contact_steps: int
    lowest: float
    highest: float


@njit(forceinline=True)
def _stays_clear(flight, tip, u, far, floor):
    """Whether a leap in which no node rises by more than `far` surely touches nothing."""
    radial, tangential, rise = load(u, 0), load(u, LANES), load(u, 2 * LANES)
    return _is_clear(tip, radial - far, absolute(tangential) + flight.sideways * far, rise + far, floor)


@njit(forceinline=True)
def _move(motion, state, touched, q, q_before, q_next):
    """Move the modes by one step, as `bladerub.contact.kernel.modal.advance`, under the forces there are."""
    if touched:
        _copy(state.force, address_of(state.force, 2 * LANES), 2 * LANES)
        _copy(state.push, address_of(state.push, LANES), LANES)
        _copy(state.moment, address_of(state.moment, LANES), LANES)
        if not motion.corrects:
            return advance_under(motion, state.force, q, q_before, q_next)
    return advance(motion, q, q_before, q_next)


@njit(forceinline=True)
def _meet(motion, stator, tip, state, when, where):
    """Let the tip meet the casing at the end of a step, or leave it.

    Returns
    -------
    within, touching : bool
        Whether the tip stayed within bounds, and whether it touches now.
    """
    touched, clear, passed, per_step = when
    q, q_next, u_before, u, u_next = where
    touching = False
    if clear:
        _clear(state.force, 2 * LANES)
        _clear(state.push, LANES)
        _clear(state.way, 2 * LANES)
    else:
        if stator.reverses:
            friction.foresee(motion, tip, state, q_next, q, per_step)
            within = _find_forces(motion, stator, tip, passed, state, u_next, True)
        else:
            within = _find_forces(motion, stator, tip, passed, state, u_next, False)
        if not within:
            _copy(address_of(state.force, 2 * LANES), state.force, 2 * LANES)
            return False, False
        touching = largest_lane(load(state.push, 0)) > 0.0
    if touching or touched:
        _settle(stator, tip, passed, per_step, state, u_next, u)
    if touching and motion.corrects:
        radial, tangential = push_modes(motion, state.force, q_next)
        _put(tip, radial, tangential, u_next)
    if touched:
        _enter_work(state, u_next, u_before)
        _clear(address_of(state.push, LANES), LANES)
    return True, touching


@njit_on_disk()
def _march(motion, flight, stator, tip, state, steps_per_element, first, last, displacement):
    turns = n_leaps = n_contact = 0
    bottom, top = np.inf, -np.inf
    per_step = 1.0 / steps_per_element
    touched = touching = largest_lane(load(state.push, 0)) > 0.0
    leapt, far = False, 0.0
    damping = broadcast(0.0)
    q, q_before, q_next = state.q, address_of(state.q, motion.n), address_of(state.q, 2 * motion.n)
    u, u_before, u_next = state.u, address_of(state.u, 3 * LANES), address_of(state.u, 6 * LANES)
    for element in range(first, last):
        if element & 31 == 0:
            _drop_negligible(state.q, 3 * motion.n)
        floor = read(stator.floor, element)
        mean = 0.0
        step = 0
        while step < steps_per_element:
            if touching or step + flight.n_steps > steps_per_element:
                leapt = False
            else:
                if not leapt:
                    far = free_flight.reach(flight, motion.n, q, q_before)
                leapt = _stays_clear(flight, tip, u, far, floor)
            if leapt:
                touched = False
                node_1 = read(u, 0)
                radial, tangential, loss, way, far = free_flight.take(flight, motion, q, q_before, q_next)
                _put(tip, radial, tangential, u)
                damping = damping + loss
                mean += flight.n_steps * (node_1 + way)
                low, high = free_flight.extremes(node_1, read(u, 0), node_1 + way)
                bottom, top = min(bottom, low), max(top, high)
                step += flight.n_steps
                n_leaps += 1
                continue
            for _ in range(min(flight.n_steps, steps_per_element - step)):
                touched = touching
                radial, tangential, loss = _move(motion, state, touched, q, q_before, q_next)
                rise = _put(tip, radial, tangential, u_next)
                damping = damping + loss
                step += 1
                clear = _is_clear(tip, radial, tangential, rise, floor)
                if touched or not clear:
                    passed = element + step * per_step
                    when = touched, clear, passed, per_step
                    where = q, q_next, u_before, u, u_next
                    within, touching = _meet(motion, stator, tip, state, when, where)
                    if not within:
                        _copy(q, q_next, motion.n)  # the damping loss is complete up to here
                        _enter(state.ledger, DAMPING, damping)
                        return turns, turns + n_leaps * flight.n_steps, n_leaps, n_contact, bottom, top
                    n_contact += touching
                node_1, node_1_before = read(u_next, 0), read(u, 0)
                mean += 0.5 * (node_1_before + node_1)
                bottom, top = min(bottom, node_1), max(top, node_1)
                turns += 1
                q, q_before, q_next = q_next, q, q_before
                u, u_before, u_next = u_next, u, u_before
        write(displacement, element - first, mean * per_step)
    _enter(state.ledger, DAMPING, damping)
    if not (touched or touching):  # the last step added nothing
        _clear(address_of(state.ledger, STORED * LANES), 4 * LANES)
    return turns, turns + n_leaps * flight.n_steps, n_leaps, n_contact, bottom, top
