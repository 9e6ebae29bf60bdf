from dataclasses import astuple
from functools import cache
from typing import NamedTuple

import numpy as np
import pytest
from numba import njit

from bladerub.contact import energy
from bladerub.contact.kernel import free_flight, modal
from bladerub.contact.kernel.loop import Simulation
from bladerub.contact.laws import module_for
from bladerub.contact.modes import modes_at
from bladerub.contact.schemes import SCHEMES, Contact
from bladerub.contact.setup import set_up
from bladerub.numerics.memory import address_of, addresses, aligned

STEPS = 7
SLOPE = 0.02
EDGE = 2.5


class Flight(NamedTuple):
    q: np.ndarray
    u: np.ndarray


@cache
def compiled(turns):
    names = ("contact.kernel.free_flight", "contact.kernel.modal", "numerics.vectors")
    free_flight, modal, vectors = (module_for(8, name, turns=turns) for name in names)

    @njit
    def flown(rule, flight, record):
        q, n = record.q, rule.n
        here = free_flight.bound(flight, n, q, address_of(q, n))
        there, loss, mean, far = free_flight.fly(flight, rule, q, address_of(q, n), address_of(q, 2 * n))
        modal.store_tip(record.u, there, there.radial)
        return vectors.lane_sum(loss), mean, far, here

    @njit
    def next_loss(rule, record):
        q, n = record.q, rule.n
        _, loss = modal.advance_free(rule, q, address_of(q, n), address_of(q, 2 * n))
        return vectors.lane_sum(loss)

    return flown, next_loss


@pytest.fixture(params=["exponential", "central_differences", "turning profile"])
def scheme(request, blade):
    step = 2.4e-6
    modes = modes_at(blade, 0.3)
    if request.param == "turning profile":
        modes = modes._replace(tip=np.vstack([modes.tip, 0.4 * modes.tip[8:, ::-1]]))
    contact = Contact(np.full(len(modes.tip) - 8, 1e5), -1.0, 0.0)
    return SCHEMES.get(request.param, SCHEMES["exponential"])(modes, 2e-3, step, contact)


@pytest.fixture
def vibration(scheme):
    """Displacement of the modes now and in the two steps before: all modes vibrate, and none is at rest."""
    rng = np.random.default_rng(3)
    q = rng.normal(size=(3, scheme.omega.size)) / scheme.omega
    q[1] = q[0] - rng.normal(size=scheme.omega.size) * scheme.time_step
    q[2] = q[1] - rng.normal(size=scheme.omega.size) * scheme.time_step
    return q


def in_steps(scheme, q, n_steps):
    history = [q[2], q[1], q[0]]
    for _ in range(n_steps):
        history.append(scheme.now * history[-1] - scheme.before * history[-2])
    return np.array(history)


def after_flight(scheme, q):
    rule, n = modal.pack(scheme), scheme.omega.size
    flight = free_flight.free_flight(scheme, STEPS, SLOPE, EDGE)
    padded = np.zeros((3, rule.n))
    padded[:, :n] = q
    record = aligned(Flight(padded, np.zeros(32)))
    flown, _ = compiled(len(scheme.tip) > 16)
    given = flown(addresses(rule), addresses(flight), addresses(record))
    return rule, record, given


@pytest.mark.extras(cases=r"turning")
def test_free_flight_equals_its_single_steps(scheme, vibration):
    rule, record, (loss, mean, *_) = after_flight(scheme, vibration)
    n = scheme.omega.size
    after = in_steps(scheme, vibration, STEPS)
    np.testing.assert_allclose(record.q[:2, :n], after[:-3:-1], rtol=0, atol=1e-13 * np.abs(after).max())
    tip = after @ scheme.tip.T
    np.testing.assert_allclose(record.u[: tip.shape[1]], tip[-1], rtol=0, atol=1e-12 * np.abs(tip).max())
    node_1 = tip[2:, 0]
    assert mean == pytest.approx(np.trapezoid(node_1) / STEPS - node_1[0], rel=1e-9)
    # a step enters the loss of the step before: the next one must find nothing left of the flight
    lost = np.sum(scheme.loss * (after[2:] - after[:-2]) ** 2)
    assert loss == pytest.approx(lost, rel=1e-10)
    _, next_loss = compiled(len(scheme.tip) > 16)
    assert next_loss(addresses(rule), addresses(record)) == 0.0


@pytest.mark.extras(cases=r"turning")
def test_no_node_approaches_by_more_than_the_bound(scheme, vibration):
    _, _, (*_, next_bound, bound) = after_flight(scheme, vibration)
    tip = in_steps(scheme, vibration, 2 * STEPS)[2:] @ scheme.tip.T
    for start, limit in ((0, bound), (STEPS, next_bound)):
        moved = np.abs(tip[start : start + STEPS + 1] - tip[start])
        tilt = moved[:, 16:] if tip.shape[1] > 16 else 0.0
        approach = (moved[:, :8] + SLOPE * moved[:, 8:16] + EDGE * tilt).max()
        assert approach <= limit < 30 * approach
        assert moved[:, 8:16].max() <= free_flight.free_flight(scheme, STEPS, SLOPE, EDGE).sideways * limit


@pytest.mark.extras(cases=r"turning")
@pytest.mark.parametrize("moves", [False, True], ids=["deflected", "moving"])
def test_the_bound_of_a_single_mode_is_what_it_reaches(scheme, moves):
    """Only the sum over modes makes it a bound: a single mode that starts so reaches all of it."""
    n = scheme.omega.size
    radial, tangential = np.abs(scheme.tip[:8]).max(axis=0), np.abs(scheme.tip[8:16]).max(axis=0)
    tilt = np.abs(scheme.tip[16:]).max(axis=0, initial=0.0)
    for mode in (0, 1, n // 2, n - 1):
        q = np.zeros((3, n))
        q[1:, mode] = -1.0 if moves else 1.0
        q[0, mode] = 0.0 if moves else 1.0
        *_, bound = after_flight(scheme, q)[2]
        reached = np.abs(in_steps(scheme, q, STEPS)[2:, mode] - q[0, mode]).max()
        assert bound == pytest.approx(reached * (radial + SLOPE * tangential + EDGE * tilt)[mode], rel=1e-9)


@pytest.mark.extras(cases=r"turning")
def test_the_bound_of_the_next_flight_is_that_from_where_the_first_ends(scheme, vibration):
    *_, next_bound, _ = after_flight(scheme, vibration)[2]
    end = in_steps(scheme, vibration, STEPS)[:-4:-1]
    *_, bound = after_flight(scheme, end)[2]
    assert next_bound == pytest.approx(bound, rel=1e-9)


@pytest.mark.parametrize(("E", "theta"), [(1.1, 0.0), (20.0, 0.1), (np.inf, 0.0)])
def test_a_run_is_the_same_without_free_flight(blade, spec, change, E, theta):
    spec = change(spec, E=E, K=E / 2, theta=theta, clearance=(2e-4, 2.5e-4), initial_displacement=1e-6)
    spec = change(spec, amplitude=4e-3, interference=4e-4)
    results = []
    for may_fly in (True, False):
        rule, run = set_up(blade, spec)
        if not may_fly:
            never = run.flight._replace(n_steps=run.steps_per_element + 1)
            run = Simulation(run.modal, never, run.stator, run.tip, run.state, run.steps_per_element)
        displacement = np.zeros((3, 200))
        results.append(([run.advance(revolution) for revolution in displacement], displacement, run.state))
    (made, displacement, state), (stepwise, expected, state_stepwise) = results
    assert sum(a.n_flights for a in made) > 100
    assert not any(b.n_flights for b in stepwise)
    assert [a.n_steps for a in made] == [b.n_steps for b in stepwise]
    assert [a.n_contact_steps for a in made] == [b.n_contact_steps for b in stepwise]
    assert sum(a.n_contact_steps for a in made) > 100
    tolerance = 1e-9 if np.isfinite(E) else 1e-4  # heights are found to 1e-11 m, and impacts spread that
    scale = np.abs(expected).max()
    np.testing.assert_allclose(displacement, expected, rtol=0, atol=tolerance * scale)
    for a, b in zip(made, stepwise, strict=True):
        assert a[3:] == pytest.approx(b[3:], abs=1e-2 * scale)  # of the parabola: elements are long here
    entries, stepwise = (astuple(energy.balance(rule, end, 0.0, 1.0)) for end in (state, state_stepwise))
    assert entries == pytest.approx(stepwise, rel=tolerance, abs=tolerance * max(stepwise))
