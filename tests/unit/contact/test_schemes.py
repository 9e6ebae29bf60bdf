"""The contract of the schemes, number by number where it can be seen without contact."""

import numpy as np
import pytest

from bladerub.contact.modes import Modes, modes_at
from bladerub.contact.schemes import FASTEST_PHASE, STEADY, Contact, central_differences, exponential

SOFT = Contact(np.full(8, 1e5), -1.0, 0.0)
RIGID = Contact(np.full(8, np.inf), -np.cos(0.15), -np.sin(0.15))
XI = 2.3e-3


def static_compliance(modes):
    return (modes.tip / modes.omega**2) @ modes.tip.T


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
    rest = rule.tip * rule.gain / (1 - rule.now + rule.before)
    np.testing.assert_allclose(
        rest @ rule.tip.T + rule.static_compliance, static_compliance(modes), rtol=1e-5, atol=1e-15
    )


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
        companion = np.block(
            [
                [np.diag(rule.now) - coupling, -np.diag(rule.before)],
                [np.eye(rule.omega.size), np.zeros((rule.omega.size,) * 2)],
            ]
        )
        assert np.abs(np.linalg.eigvals(companion)).max() <= 1 + 1e-9
    assert resolved[0] >= resolved[1]
    assert STEADY < 1


def test_only_the_rigid_casing_is_met_implicitly_by_central_differences(blade):
    modes = modes_at(blade, 0.3)
    assert not central_differences(modes, XI, 2e-6, SOFT).compliance.any()
    rule = central_differences(modes, XI, 2e-6, RIGID)
    force = np.arange(16.0)
    np.testing.assert_allclose(
        rule.compliance @ force, rule.tip @ (force @ (rule.tip * rule.gain)), rtol=1e-12
    )


def test_step_too_long_is_refused(blade):
    modes = modes_at(blade, 0.3)
    for scheme, h in ((central_differences, 2e-5), (exponential, 1.0)):
        with pytest.raises(ValueError, match="time step"):
            scheme(modes, XI, h, SOFT)
