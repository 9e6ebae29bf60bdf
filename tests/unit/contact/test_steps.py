import math
from dataclasses import replace

import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from bladerub.contact import setup
from bladerub.contact.modes import Modes, mode_shapes_at, modes_at
from bladerub.contact.schemes import FASTEST_PHASE, Contact, central_differences, exponential
from bladerub.contact.steps import AVERAGED, BOUNCE, PASSAGE, STABLE_PART, bounce, steps_per_element

MASS, STIFFNESS = 1e-3, 2e7
SOFT = Contact(np.full(8, 1e5), -1.0, 0.0)
RIGID = Contact(np.full(8, np.inf), -np.cos(0.15), -np.sin(0.15))
XI = 2.3e-3


@pytest.fixture
def mass():
    """A tip of one node on springs so weak that it is free: radial and tangential motion."""
    return Modes(np.full(2, 1e-3), np.eye(2) / math.sqrt(MASS), 1)


def contact(stiffness=STIFFNESS):
    return Contact(np.array([stiffness]), -1.0, 0.0)


@pytest.fixture
def by_tolerance(spec, change):
    return lambda **values: change(spec, **{"steps_per_element": 0, "max_time_step": math.inf, **values})


def test_a_free_mass_bounces_with_its_spring_and_a_fast_mode_yields_by_its_static_displacement(mass):
    assert bounce(mass, contact(), 1e-6) == pytest.approx((1e-6 / 2) ** 2 * STIFFNESS / MASS)
    fast = mass._replace(omega=np.full(2, 1e9))
    assert bounce(fast, contact(), 1e-3) == pytest.approx(STIFFNESS / MASS / 1e18, rel=1e-6)


@pytest.mark.parametrize("tolerance", [1e-3, 1e-2, 4e-2])
@pytest.mark.parametrize("stiffness", [1e3, 2e7, 8e8])
def test_as_few_steps_as_the_sum_of_both_errors_allows(by_tolerance, mass, tolerance, stiffness):
    run, passage = by_tolerance(tolerance=tolerance), 1.3e-5
    n = steps_per_element(run, mass, contact(stiffness), passage)
    bounces = passage * math.sqrt(stiffness / MASS) / (2 * math.pi)
    of_bounce = (passage / 2) ** 2 * stiffness / MASS / BOUNCE * math.sqrt(min(1, AVERAGED / bounces))
    assert (bounces > AVERAGED) == (stiffness == 8e8)
    assert n == math.ceil(math.sqrt((PASSAGE**2 + of_bounce) / tolerance))


@pytest.mark.extras
def test_a_law_that_depends_on_the_rate_counts_half_a_step(blade, by_tolerance):
    from bladerub.extras.law_reading import described_law

    run = by_tolerance(E=0.01, tolerance=1e-2)
    viscous = replace(run.coating, element_law=described_law("viscoplastic", {"viscosity": 1e4}))
    assert setup.fixed_steps(blade, run).steps_per_element == 4
    assert setup.fixed_steps(blade, replace(run, coating=viscous)).steps_per_element == 19


def test_central_differences_are_stable(blade, by_tolerance):
    run = by_tolerance(scheme="central_differences")
    rule, _ = setup.set_up(blade, run)
    assert rule.omega[-1] * rule.time_step <= 2 * STABLE_PART


def test_modes_diagonalise_the_blade_and_give_its_static_tip_compliance(blade):
    modes = modes_at(blade, 0.3)
    compliance = (modes.tip / modes.omega**2) @ modes.tip.T
    load = np.zeros(30)
    load[:3] = blade.radial_direction[0]
    u = np.linalg.solve(blade.stiffness(0.3), load)
    radial = np.einsum("ja,ja->j", blade.radial_direction, u[:24].reshape(8, 3))
    tangential = np.einsum("ja,ja->j", blade.tangential_direction, u[:24].reshape(8, 3))
    np.testing.assert_allclose(compliance[0], np.concatenate([radial, tangential]), rtol=1e-9, atol=1e-16)


@pytest.mark.extras
def test_turn_of_the_whole_blade_about_the_axis_tilts_no_profile(blade, spec):
    """The tip's slope is minus the angle then, and the normal of the casing turns with the nodes."""
    from bladerub.extras.turning.motion import further

    _, y, z = blade.node_position.T
    turn = np.concatenate([np.column_stack([0 * y, z, -y]).ravel(), np.zeros(6)])
    turning = replace(blade, tip_slope=-np.outer(np.ones(8), turn) / (turn @ turn))
    np.testing.assert_allclose(further(turning, turn[:, None], spec), 0.0, rtol=0, atol=1e-12)
    along = replace(blade, tip_slope=np.zeros((8, turn.size)))  # it moves and does not turn
    width = 2 * np.pi * 0.65 / spec.coating.n_elements
    np.testing.assert_allclose(further(along, turn[:, None], spec), width)


def test_the_shapes_do_not_depend_on_the_threads_of_who_asks_first(blade):
    found = []
    for threads in (1, 2):
        with threadpool_limits(threads, "blas"):
            unknown = replace(blade)  # another one, whose modes were not asked for
            found.append(mode_shapes_at(unknown, 0.3))
    for one, other in zip(*found, strict=True):
        np.testing.assert_array_equal(one, other)
        assert not one.flags.writeable  # all who ask share them


def test_central_differences_repeat_the_discrete_free_vibration(blade):
    """Undamped, they move a mode at 2/h asin(ω h/2) exactly."""
    modes = modes_at(blade, 0.0)
    h = 2e-6
    rule = central_differences(modes, 0.0, h, SOFT)
    phase = 2 * np.arcsin(modes.omega * h / 2)
    np.testing.assert_allclose(rule.now * np.cos(phase) - rule.before, np.cos(2 * phase), atol=1e-12)


@pytest.mark.parametrize("h", [1e-7, 2e-6, 2e-5])
def test_exponential_free_vibration_is_exact_at_any_step(blade, h):
    modes = modes_at(blade, 0.2)
    rule = exponential(modes, XI, h, SOFT)
    omega = rule.omega
    assert omega[-1] * h <= FASTEST_PHASE
    damped = omega * np.sqrt(1 - XI**2)

    def q(t):
        return np.exp(-XI * omega * t) * np.cos(damped * t + 0.3)

    np.testing.assert_allclose(rule.now * q(5 * h) - rule.before * q(4 * h), q(6 * h), rtol=0, atol=1e-12)


@pytest.mark.parametrize("h", [1e-7, 1e-6, 2e-5])
@pytest.mark.parametrize("scheme", [central_differences, exponential])
def test_a_constant_force_leads_to_its_static_displacement(blade, h, scheme):
    """Resolved and condensed modes together answer as the whole blade does."""
    modes = modes_at(blade, 0.3)
    if scheme is central_differences:
        h = min(h, 1e-5)
    rule = scheme(modes, XI, h, SOFT)
    found = rule.tip * rule.gain / (1 - rule.now + rule.before) @ rule.tip.T + rule.static_compliance
    static = (modes.tip / modes.omega**2) @ modes.tip.T
    np.testing.assert_allclose(found, static, rtol=1e-5, atol=1e-15)


def test_a_body_without_support_flies_on():
    """ω = 0: q⁺ = 2 q − q⁻ + h² F."""
    tip = np.zeros((16, 2))
    tip[0] = 0.5, 0.7
    rule = exponential(Modes(np.array([0.0, 100.0]), tip, 8), 0.0, 1e-4, SOFT)
    assert (rule.now[0], rule.before[0]) == (2.0, 1.0)
    assert (rule.tip * rule.gain)[0, 0] == pytest.approx(0.5e-8)


@pytest.mark.parametrize("h", [5e-6, 2e-5])
def test_fast_modes_are_condensed_until_contact_is_steady(blade, h):
    """The blade in lasting contact is a linear recurrence: all its roots stay within the unit circle."""
    modes = modes_at(blade, 0.3)
    resolved = []
    for stiffness in (1e5, 1e8, np.inf):
        contact = Contact(np.full(8, stiffness), -1.0, 0.0)
        rule = exponential(modes, 0.0, h, contact)
        resolved.append(rule.omega.size)
        flexibility = np.eye(8) / stiffness + rule.compliance[:8, :8]
        stiff = np.linalg.inv(flexibility)  # of coating and condensed modes in series
        coupling = (rule.tip * rule.gain)[:8].T @ stiff @ rule.tip[:8]
        last = [np.eye(rule.omega.size), np.zeros((rule.omega.size,) * 2)]
        companion = np.block([[np.diag(rule.now) - coupling, -np.diag(rule.before)], last])
        assert np.abs(np.linalg.eigvals(companion)).max() <= 1 + 1e-9
    assert resolved[0] >= resolved[1]
    phase = np.append(modes.omega * h, FASTEST_PHASE)[: rule.omega.size + 1]  # against the rigid casing
    share = 1 - (phase[:-1] / min(FASTEST_PHASE, phase[-1])) ** 2
    np.testing.assert_allclose(rule.tip, modes.tip[:, : share.size] * share, rtol=1e-12)


def test_only_the_rigid_casing_is_met_implicitly_by_central_differences(blade):
    modes = modes_at(blade, 0.3)
    assert not central_differences(modes, XI, 2e-6, SOFT).compliance.any()
    rule = central_differences(modes, XI, 2e-6, RIGID)
    force = np.arange(16.0)
    moved = rule.tip @ (force @ (rule.tip * rule.gain))
    np.testing.assert_allclose(rule.compliance @ force, moved, rtol=1e-12)


def test_step_too_long_is_refused(blade):
    modes = modes_at(blade, 0.3)
    for scheme, h in ((central_differences, 2e-5), (exponential, 1.0)):
        with pytest.raises(ValueError, match="time step"):
            scheme(modes, XI, h, SOFT)
