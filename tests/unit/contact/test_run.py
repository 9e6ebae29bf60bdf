"""The compiled loop against the NumPy reference, and what a run promises."""

import numpy as np
import pytest
import reference

from bladerub.contact.run import STRAY, simulate, strip_width


@pytest.mark.parametrize(
    ("E", "K", "theta"), [(1.1, 0.5, 0.0), (0.11, 10.0, 0.15), (20.0, 0.05, 0.1), (2.0, 0.0, 0.0)]
)
def test_loop_agrees_with_numpy_reference_to_rounding(blade, spec, change, E, K, theta):
    spec = change(spec, E=E, K=K, theta=theta, revolutions=1)
    result = simulate(blade, spec)
    history, wear = reference.simulate(blade, spec, result.n_steps)
    node_1 = history[:, 0]
    per_element = node_1.reshape(spec.coating.n_elements, -1).mean(axis=1)
    scale = np.abs(node_1).max()
    assert np.count_nonzero(wear.max(axis=1)) == 8  # every node rubs
    np.testing.assert_allclose(result.radial_displacement, per_element, rtol=0, atol=1e-9 * scale)
    np.testing.assert_allclose(result.wear, wear, rtol=0, atol=1e-9 * wear.max())
    assert result.revolution_peak[0] == pytest.approx(scale, rel=1e-9)


def test_large_tangential_motion_agrees_with_reference(blade, spec, change):
    """Nodes wander over several elements and the curvature counts: the search leaves its shortcut."""
    spec = change(spec, n_elements=4000, interference=0.35e-3, E=2.0, K=10.0, theta=0.8, revolutions=1)
    spec = change(spec, max_time_step=5e-6)
    result = simulate(blade, spec)
    history, wear = reference.simulate(blade, spec, result.n_steps)
    assert result.status == "completed"
    assert np.abs(history[:, 8:]).max() * 4000 / (2 * np.pi * 0.65) > STRAY + 1
    np.testing.assert_allclose(result.wear, wear, rtol=0, atol=1e-8 * wear.max())


def test_no_contact_leaves_everything_at_rest(blade, spec, change):
    result = simulate(blade, change(spec, interference=0.0))
    assert result.status == "completed"
    assert result.n_contact_steps == 0
    assert not result.wear.any()
    assert not result.radial_displacement.any()


def test_energy_ledger_of_the_blade_closes(blade, spec, change):
    for theta in (0.0, 0.2):
        energy = simulate(blade, change(spec, theta=theta)).energy
        work = energy.work_radial + energy.work_tangential
        assert energy.kinetic + energy.elastic == pytest.approx(work - energy.damping, rel=1e-9)
        assert energy.wear > 0
        assert (energy.work_tangential == 0) == (theta == 0)


def test_wear_loss_is_that_of_the_worn_profile(blade, spec, change):
    """Elements wear under the middle of the tip: each has lost nearly σ_Y w + K w²/2 per thickness."""
    spec = change(spec, half_width=4.0, edge_drop=2e-3, E=5.0, f_omega=0.05)
    result = simulate(blade, spec)
    area = strip_width(blade)[:, None] * 2 * np.pi * 0.65 / spec.coating.n_elements
    hardening = spec.coating.K * spec.coating.modulus_unit / spec.coating.thickness
    strength = spec.coating.yield_stress * spec.coating.modulus_unit
    expected = area * (strength * result.wear + 0.5 * hardening * result.wear**2)
    assert result.energy.wear == pytest.approx(expected.sum(), rel=1e-9)


def test_step_divides_the_passage_of_an_element(blade, spec):
    result = simulate(blade, spec)
    passage = 1 / (spec.f_omega * blade.f1_hz * spec.coating.n_elements)
    steps = passage / result.time_step
    assert steps == pytest.approx(round(steps), abs=1e-9)
    assert result.time_step <= spec.max_time_step
    assert result.n_steps == round(steps) * spec.coating.n_elements * spec.revolutions
    assert result.radial_displacement.shape == (spec.revolutions * spec.coating.n_elements,)
    assert result.angle[[0, -1]] == pytest.approx([np.pi / 200, 2 * np.pi - np.pi / 200])


def test_longer_run_begins_like_the_shorter_one(blade, spec, change):
    short, long = simulate(blade, spec), simulate(blade, change(spec, revolutions=4))
    n = short.radial_displacement.size
    np.testing.assert_array_equal(short.radial_displacement, long.radial_displacement[:n])
    np.testing.assert_array_equal(short.revolution_peak, long.revolution_peak[: spec.revolutions])


def test_common_turn_of_casing_and_start_changes_nothing_but_the_angle(blade, spec, change):
    """A 2-diameter casing is the same after half a turn."""
    spec = change(spec, nodal_diameters=(2,), weights=(1.0,), start_angle=np.pi / 2)
    here, there = simulate(blade, spec), simulate(blade, change(spec, start_angle=3 * np.pi / 2))
    scale = np.abs(here.radial_displacement).max()
    np.testing.assert_allclose(here.radial_displacement, there.radial_displacement, atol=1e-8 * scale)
    np.testing.assert_allclose(np.roll(here.wear, 100, axis=1), there.wear, atol=1e-8 * here.wear.max())


def test_unbounded_run_stops_and_keeps_its_data(blade, spec, change):
    whole = simulate(blade, spec)
    limit = 0.5 * np.abs(whole.revolution_peak).max()
    result = simulate(blade, change(spec, displacement_limit=limit))
    assert result.status == "unbounded"
    assert f"{limit:g} m" in result.message
    assert 0 < result.n_steps < whole.n_steps
    done = np.isfinite(result.radial_displacement)
    assert 0 < done.sum() < done.size
    np.testing.assert_array_equal(result.radial_displacement[done], whole.radial_displacement[done])
    assert result.wear.max() > 0
    energy = result.energy
    work = energy.work_radial + energy.work_tangential
    assert energy.kinetic + energy.elastic == pytest.approx(work - energy.damping, rel=1e-9)


def test_numerical_blow_up_ends_as_unbounded(blade, spec, change):
    """A bar far stiffer than the step can follow: the run is flagged, no index leaves a table."""
    result = simulate(blade, change(spec, E=1e7, K=1e9))
    assert result.status == "unbounded"


def test_progress_counts_revolutions(blade, spec):
    seen = []
    simulate(blade, spec, progress=seen.append)
    assert seen == [1, 2]


def test_step_too_long_for_the_highest_mode_is_refused(blade, spec, change):
    with pytest.raises(ValueError, match=r"time step .* less than .* for the highest mode"):
        simulate(blade, change(spec, max_time_step=2e-5))


def test_speed_outside_the_model_is_refused(blade, spec, change):
    with pytest.raises(ValueError, match=r"f_omega = 0\.5 is outside the fitted range \[0, 0\.4\]"):
        simulate(blade, change(spec, f_omega=0.5))
