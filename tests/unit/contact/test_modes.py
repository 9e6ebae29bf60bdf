import numpy as np
import pytest

from bladerub.contact.modes import central_differences, modes_at


def test_modes_diagonalise_the_blade_and_give_its_static_tip_compliance(blade):
    modes = modes_at(blade, 0.3)
    compliance = (modes.tip / modes.omega**2) @ modes.tip.T
    load = np.zeros(30)
    load[:3] = blade.radial_direction[0]
    u = np.linalg.solve(blade.stiffness(0.3), load)
    radial = np.einsum("ja,ja->j", blade.radial_direction, u[:24].reshape(8, 3))
    tangential = np.einsum("ja,ja->j", blade.tangential_direction, u[:24].reshape(8, 3))
    np.testing.assert_allclose(compliance[0], np.concatenate([radial, tangential]), rtol=1e-9, atol=1e-16)


def test_frequencies_rise_with_the_speed(blade):
    assert np.all(modes_at(blade, 0.4).omega > modes_at(blade, 0.0).omega)


def test_recurrence_repeats_the_discrete_free_vibration(blade):
    """Undamped central differences move a mode at 2/h asin(ω h/2) exactly."""
    modes = modes_at(blade, 0.0)
    h = 2e-6
    rule = central_differences(modes, 0.0, h)
    phase = 2 * np.arcsin(modes.omega * h / 2)
    np.testing.assert_allclose(rule.now * np.cos(phase) - rule.before, np.cos(2 * phase), atol=1e-12)


def test_compliance_is_the_tip_response_of_one_step(blade):
    rule = central_differences(modes_at(blade, 0.2), 2.3e-3, 2e-6)
    force = np.arange(16.0)
    np.testing.assert_allclose(rule.compliance @ force, rule.tip @ (force @ rule.response), rtol=1e-12)


def test_indefinite_stiffness_is_refused(blade):
    import dataclasses

    broken = dataclasses.replace(blade, stiffness_0=-blade.stiffness_0)
    with pytest.raises(ValueError, match="not positive definite"):
        modes_at(broken, 0.0)
