"""The time loop, by the contract of `bladerub.contact.schemes`.

Each step advances the modes, projects them on the tip and finds the contact forces there.

Compiled functions on the addresses of the arrays of five records, which `Simulation` keeps; no input or
output. Where the tip surely touches nothing, many steps are made at once (`free_flight`).
"""

from typing import Any, NamedTuple

import numpy as np

from bladerub.contact.energy import DAMPING, STORED
from bladerub.contact.gap import is_within_limit, normal_approach
from bladerub.contact.kernel import free_flight
from bladerub.contact.kernel.accounting import add_work, update_coating
from bladerub.contact.kernel.coulomb import predict_sliding
from bladerub.contact.kernel.elements import is_clear
from bladerub.contact.kernel.free_flight import FreeFlight
from bladerub.contact.kernel.modal import APPROACH, Modal, advance_forced, advance_free, correct, store_tip
from bladerub.contact.kernel.newton import find_forces
from bladerub.contact.kernel.records import State, Stator, Tip, check, shapes
from bladerub.contact.laws import solver_digest
from bladerub.numerics.machine_code import inlined, njit_on_disk, within
from bladerub.numerics.memory import add_to, address_of, addresses, clear, copy, load, read, store, write
from bladerub.numerics.vectors import LANES, absolute, broadcast, largest_lane, where

NEGLIGIBLE = 1e-100  # m kg^1/2: smaller modal coordinates become 0, subnormal numbers would slow the loop
CLEANING_INTERVAL = 32  # elements between two searches for negligible modal coordinates


class Progress(NamedTuple):
    """What was integrated in a revolution or a part of it."""

    n_steps: int  # Fewer than asked for when a displacement exceeds the limit
    n_flights: int  # Free flights, which many of the steps were made in
    n_contact_steps: int  # Steps with contact
    lowest: float  # Range of the radial displacement of node 1, m
    highest: float


class Simulation:
    """A blade and a stator, ready to be integrated.

    `modal` are the coefficients of the scheme for one step, `flight` those for many steps of free flight.
    `advance` changes `state`. The passage of one element takes `steps_per_element` time steps. `layer` is
    what the law lets happen in the coating between passages, if it does.
    """

    def __init__(
        self,
        modal: Modal,
        flight: FreeFlight,
        stator: Stator,
        tip: Tip,
        state: State,
        steps_per_element: int,
        layer: Any = None,
    ):
        self.modal, self.flight, self.stator, self.tip, self.state = modal, flight, stator, tip, state
        self.steps_per_element, self.layer = steps_per_element, layer
        shape = shapes(modal.n, stator.n_elements)
        records = modal, flight, stator, tip, state
        for record in records:
            check(record, shape)
        state.tangential_factor[:] = stator.tangential_factor  # Coulomb's law finds its own before it is used
        self.records = Records(*(addresses(record) for record in records))

    @property
    def angle_per_step(self) -> float:
        """Angle by which the blade turns in a step, rad."""
        return 2 * np.pi / (self.steps_per_element * self.stator.n_elements)

    def advance(self, displacement: np.ndarray, first: int = 0) -> Progress:
        """Integrate a revolution, or the part of it from element `first` on, at constant speed.

        `displacement` (n,) is filled with the radial displacement of node 1, mean over the passage of each
        element, m; n = N makes one revolution.
        """
        if self.layer is not None:
            return self.layer.advance(self, displacement, first)
        return self.integrate(displacement, first)

    def integrate(self, displacement: np.ndarray, first: int) -> Progress:
        """Integrate as `advance`, without what the law lets happen between passages."""
        last, address = first + displacement.size, displacement.ctypes.data
        _, _, *done = integrate(self.records, self.steps_per_element, first, last, False, 0.0, address)
        return Progress(*done)


class Records(NamedTuple):
    """Addresses of all that the loop works on.

    A named tuple: the type that Numba gives a plain one of records is shared by name with those of other
    laws and numbers of nodes, whose modules a later process lacks when it reads machine code from the disk.
    """

    modal: Modal
    flight: FreeFlight
    stator: Stator
    tip: Tip
    state: State


class Step(NamedTuple):
    """One step of the rotation, with the addresses of modal coordinates and tip displacements."""

    touched: bool  # Whether there was contact before it
    travel: float  # Elements passed at its end
    per_step: float  # Elements passed in it
    angle: float  # Angle passed in it, rad
    q: int  # Now, and to come
    q_next: int
    u_before: int  # One step before, now, and to come
    u: int
    u_next: int


@inlined
def _store_displacement(tip, displacement, u):
    """Store a displacement of the tip and the approach of its nodes; return this."""
    approach = normal_approach(tip, displacement.radial, displacement.tangential)
    store_tip(u, displacement, approach)
    return approach


@inlined
def _stays_clear(modal, flight, tip, u, reach, minimum_gap):
    """Whether a free flight in which no node approaches by more than `reach` surely touches nothing."""
    radial, tangential, approach = load(u, 0) - reach, load(u, LANES), load(u, APPROACH) + reach
    sideways = absolute(tangential) + flight.sideways * reach
    return is_clear(tip, radial, sideways, approach, u, minimum_gap)


@inlined
def _advance(modal, state, touched, q, q_before, q_next):
    """Move the modes by one step under the forces there are, and keep these as those of the step before."""
    if touched:
        copy(state.force, address_of(state.force, 3 * LANES), 3 * LANES)
        copy(state.normal_force, address_of(state.normal_force, LANES), LANES)
        copy(state.moment, address_of(state.moment, LANES), LANES)
        copy(state.tangential_factor, address_of(state.tangential_factor, LANES), LANES)
        if not modal.corrects:
            return advance_forced(modal, state.force, q, q_before, q_next)
    return advance_free(modal, q, q_before, q_next)


@inlined
def _contact(modal, stator, tip, state, step, clear_of_casing):
    """Find the contact forces at the end of a step, and what they do to coating, modes and ledger.

    Returns whether the displacement is within the limit, and whether there is contact now.
    """
    touching = False
    within = True
    if not step.touched:  # the forces before are of an older contact
        clear(address_of(state.force, 3 * LANES), 3 * LANES)
    if modal.corrects and step.touched:  # the last correction moved the tip after its limit was checked
        within = is_within_limit(tip, load(step.u, 0), load(step.u, LANES))
    if within and clear_of_casing:
        clear(state.force, 3 * LANES)
        clear(state.normal_force, LANES)
        clear(state.response, 3 * LANES)
    elif within:
        if stator.coulomb:
            predict_sliding(modal, state, step.q_next, step.q, step.angle)
            within = find_forces(modal, stator, tip, step.travel, state, step.u_next, True)
        else:
            within = find_forces(modal, stator, tip, step.travel, state, step.u_next, False)
        touching = within and largest_lane(load(state.normal_force, 0)) > 0.0
    if not within:
        copy(address_of(state.force, 3 * LANES), state.force, 3 * LANES)
        return False, False
    if touching or step.touched:
        update_coating(stator, tip, step.travel, step.per_step, state, step.u_next, step.u)
    if touching and modal.corrects:
        _store_displacement(tip, correct(modal, state.force, step.q_next), step.u_next)
    if step.touched:
        add_work(stator, tip, step.angle, state, step.u_next, step.u, step.u_before)
        clear(address_of(state.normal_force, LANES), LANES)
    return True, touching


@inlined
def _clear_negligible(q, n):
    for k in range(0, n, LANES):
        x = load(q, k)
        store(q, k, where(absolute(x) > NEGLIGIBLE, x, 0.0))


@within
def _put_in_order(rows, n, turns):
    """Bring three rows of `n` numbers, which have taken `turns`, in the order of `State`."""
    for _ in range(turns % 3):
        for k in range(n):
            last = read(rows, 2 * n + k)
            write(rows, 2 * n + k, read(rows, n + k))
            write(rows, n + k, read(rows, k))
            write(rows, k, last)


@njit_on_disk(solver_digest(), nogil=True)  # threads of one process integrate at the same time
def integrate(records, steps_per_element, first, last, is_flying, reach, displacement):
    """Integrate elements `first` to `last`; `displacement` is the address of the mean of each.

    A part that goes on gets `is_flying` and `reach` of the last. Returns both, then the fields of `Progress`.
    """
    modal, flight, stator, tip, state = records
    turns = n_flights = n_contact = 0
    within = True
    bottom, top = np.inf, -np.inf
    per_step = 1.0 / steps_per_element
    angle = per_step * (2.0 * np.pi / stator.n_elements)
    touched = touching = largest_lane(load(state.normal_force, 0)) > 0.0
    damping = broadcast(0.0)
    q, q_before, q_next = state.q, address_of(state.q, modal.n), address_of(state.q, 2 * modal.n)
    u, u_before, u_next = state.u, address_of(state.u, 4 * LANES), address_of(state.u, 8 * LANES)
    for element in range(first, last):
        if element % CLEANING_INTERVAL == 0:
            _clear_negligible(state.q, 3 * modal.n)
        minimum_gap = read(stator.minimum_gap, element)
        mean = 0.0
        step = 0
        while within and step < steps_per_element:
            if touching or step + flight.n_steps > steps_per_element:
                is_flying = False
            else:
                if not is_flying:
                    reach = free_flight.bound(flight, modal.n, q, q_before)
                is_flying = _stays_clear(modal, flight, tip, u, reach, minimum_gap)
            if is_flying:
                touched = False
                node_1 = read(u, 0)
                moved, loss, increment, reach = free_flight.fly(flight, modal, q, q_before, q_next)
                _store_displacement(tip, moved, u)
                damping = damping + loss
                mean += flight.n_steps * (node_1 + increment)
                low, high = free_flight.extremes(node_1, read(u, 0), node_1 + increment)
                bottom, top = min(bottom, low), max(top, high)
                step += flight.n_steps
                n_flights += 1
                continue
            for _ in range(min(flight.n_steps, steps_per_element - step)):
                touched = touching
                moved, loss = _advance(modal, state, touched, q, q_before, q_next)
                approach = _store_displacement(tip, moved, u_next)
                damping = damping + loss
                step += 1
                clear_of_casing = is_clear(tip, moved.radial, moved.tangential, approach, u_next, minimum_gap)
                if touched or not clear_of_casing:
                    travel = element + step * per_step
                    rotation = Step(touched, travel, per_step, angle, q, q_next, u_before, u, u_next)
                    within, touching = _contact(modal, stator, tip, state, rotation, clear_of_casing)
                    if not within:
                        copy(q, q_next, modal.n)  # the damping loss is complete up to here
                        break
                    n_contact += touching
                node_1, node_1_before = read(u_next, 0), read(u, 0)
                mean += 0.5 * (node_1_before + node_1)
                bottom, top = min(bottom, node_1), max(top, node_1)
                turns += 1
                q, q_before, q_next = q_next, q, q_before
                u, u_before, u_next = u_next, u, u_before
        if not within:
            break
        write(displacement, element - first, mean * per_step)
    add_to(state.ledger, DAMPING * LANES, damping)
    if within and not (touched or touching):  # the last step added nothing
        clear(address_of(state.ledger, STORED * LANES), 4 * LANES)
    _put_in_order(state.q, modal.n, turns)
    _put_in_order(state.u, 4 * LANES, turns)
    n_steps = turns + n_flights * flight.n_steps
    return is_flying, reach, n_steps, n_flights, n_contact, bottom, top
