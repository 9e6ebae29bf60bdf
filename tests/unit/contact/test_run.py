"""The compiled loop against the NumPy reference, and what a run promises."""

import dataclasses

import contact_in_numpy
import numpy as np
import pytest
from stand_in import made_blade

from bladerub.contact import casing, reference
from bladerub.contact.modes import modes_at
from bladerub.contact.run import simulate, simulate_longer
from bladerub.contact.setup import set_up
from bladerub.contact.start import SEARCH_RANGE
from bladerub.contact.strips import strip_width


def check(result, history, wear, spec):
    """Compare a run of a revolution with the reference; return its largest displacement of node 1."""
    atol = 1e-9 if spec.scheme == "central_differences" else 1e-6  # both find implicit forces by iteration
    scale = np.abs(history[:, 0]).max()
    expected = contact_in_numpy.element_means(history[:, 0], spec.coating.n_elements)
    np.testing.assert_allclose(result.radial_displacement, expected, rtol=0, atol=atol * scale)
    np.testing.assert_allclose(result.wear, wear, rtol=0, atol=atol * wear.max())
    return scale


@pytest.mark.parametrize(
    ("E", "K", "theta"), [(1.1, 0.5, 0.0), (0.11, 10.0, 0.15), (3.0, 0.05, 0.1), (2.0, 0.0, 0.0)]
)
@pytest.mark.parametrize(
    ("scheme", "steps"), [("central_differences", 12), ("exponential", 12), ("exponential", 6)]
)
def test_loop_agrees_with_numpy_reference_to_rounding(spec, change, scheme, steps, E, K, theta):
    spec = change(spec, E=E, K=K, theta=theta, revolutions=1)
    x = np.array([-23, -20, -12, -8, 1, 9, 14, 24]) * 1e-3  # unevenly along the chord
    angle = np.linspace(-0.05, 0.05, 8)
    blade = made_blade(np.random.default_rng(7), 192.0, x, angle, 0.65, cone=np.deg2rad(20.0))
    spec = change(spec, scheme=scheme, steps_per_element=steps, max_time_step=1e-3)
    result = simulate(blade, spec)
    history, wear = contact_in_numpy.simulate(blade, spec, result.n_steps, result.n_modes)
    if scheme == "central_differences":
        for ours, papers in zip(
            (history, wear), reference.simulate(blade, spec, result.n_steps), strict=True
        ):
            np.testing.assert_allclose(ours, papers, rtol=0, atol=1e-11 * np.abs(papers).max())
    scale = check(result, history, wear, spec)
    assert np.count_nonzero(wear.max(axis=1)) == 8  # every node rubs
    assert result.revolution_peak[0] == pytest.approx(scale, rel=3e-4)
    # peaks in free flight are those of the parabola through the ends of a leap and its mean
    assert result.revolution_amplitude[0] == pytest.approx(np.ptp(history[:, 0]) / 2, rel=3e-4)


def test_reference_takes_a_step_of_its_scheme_whatever_that_of_the_run(blade, spec, change):
    spec = change(spec, steps_per_element=0, max_time_step=np.inf)
    history, wear = reference.simulate(blade, spec, 2000)
    papers, _ = reference.simulate(blade, change(spec, scheme="central_differences"), 2000)
    np.testing.assert_array_equal(history, papers)
    assert 0 < wear.max() < 1e-3


@pytest.fixture(scope="module")
def turning_blade(blade):
    slope = np.zeros((8, len(blade.mass)))
    for node in range(8):
        slope[node, 3 * node : 3 * node + 3] = -(20.0 + 3 * node) * blade.tangential_direction[node]
        slope[node, 24 + node % 6] = 5.0
    return dataclasses.replace(blade, tip_slope=slope)


@pytest.mark.extras
@pytest.mark.parametrize(("E", "K", "theta"), [(1.1, 0.5, 0.0), (0.11, 10.0, 0.15), (3.0, 0.05, 0.1)])
@pytest.mark.parametrize("scheme", ["central_differences", "exponential"])
def test_loop_agrees_with_numpy_reference_where_the_profile_turns(
    turning_blade, spec, change, scheme, E, K, theta
):
    spec = change(spec, E=E, K=K, theta=theta, revolutions=1, turns=True, scheme=scheme, max_time_step=1e-3)
    result = simulate(turning_blade, spec)
    history, wear = contact_in_numpy.simulate(turning_blade, spec, result.n_steps, result.n_modes)
    fixed = simulate(turning_blade, change(spec, turns=False))
    assert np.abs(result.wear - fixed.wear).max() > 0.02 * wear.max()
    check(result, history, wear, spec)


@pytest.mark.extras(cases=r"values1")
@pytest.mark.parametrize(
    "values",
    [
        {"E": 3.0, "K": 0.05, "theta": 0.1},
        {"E": 3.0, "K": 0.05, "theta": 0.1, "turns": True, "scheme": "central_differences"},
        {"E": 1.1, "K": 0.5, "theta": 0.1, "law": "coulomb"},
        {"E": np.inf, "K": np.inf, "theta": 0.1, "law": "coulomb"},
    ],
)
def test_a_run_that_goes_on_is_the_longer_one_from_rest(turning_blade, spec, change, values):
    spec = change(spec, **values, revolutions=1, max_time_step=1e-5)
    run, longer = simulate_longer(turning_blade, spec, lambda result: 2 * result.revolution_peak.size + 1)
    for result, revolutions in ((run, 1), (longer, 3)):
        expected = dataclasses.asdict(simulate(turning_blade, change(spec, revolutions=revolutions)))
        np.testing.assert_equal(dataclasses.asdict(result), expected)
    assert len(simulate_longer(turning_blade, spec, lambda result: 0)) == 1


def test_rigid_casing_is_met_without_a_profile(turning_blade, spec, change):
    spec = change(spec, E=np.inf, K=np.inf, theta=0.0, revolutions=1, max_time_step=1e-3)
    fixed, turning = (simulate(turning_blade, change(spec, turns=turns)) for turns in (False, True))
    np.testing.assert_array_equal(turning.radial_displacement, fixed.radial_displacement)


def test_large_tangential_motion_agrees_with_reference(blade, spec, change):
    """Nodes wander over several elements and the curvature counts: the search leaves its shortcut."""
    spec = change(spec, n_elements=4000, interference=0.35e-3, E=2.0, K=10.0, theta=0.8, revolutions=1)
    spec = change(spec, scheme="central_differences", steps_per_element=1, max_time_step=5e-6)
    result = simulate(blade, spec)
    history, wear = contact_in_numpy.simulate(blade, spec, result.n_steps, result.n_modes)
    assert result.status == "completed"
    assert np.abs(history[:, 8:]).max() * 4000 / (2 * np.pi * 0.65) > SEARCH_RANGE + 1
    np.testing.assert_allclose(result.wear, wear, rtol=0, atol=1e-8 * wear.max())


def blade_imbalance(energy):
    gained = energy.kinetic + energy.elastic - energy.initial + energy.damping
    work = energy.work_radial + energy.work_tangential + energy.work_couple
    return abs(gained - work) / energy.exchanged


@pytest.mark.parametrize("theta", [0.0, 0.2])
@pytest.mark.parametrize("steps", [6, 12])
def test_energy_ledger_of_the_blade_closes_to_rounding(blade, spec, change, theta, steps):
    spec = change(spec, theta=theta, steps_per_element=steps, max_time_step=1e-3, initial_displacement=1e-5)
    energy = simulate(blade, spec).energy
    assert energy.initial > 0
    assert blade_imbalance(energy) < 1e-9
    assert energy.wear > 0
    assert (energy.work_rotation > 0) == (theta > 0)


@pytest.mark.extras(cases=r"True")
@pytest.mark.parametrize("turns", [False, True])
def test_energy_ledger_of_blade_and_coating_closes(turning_blade, spec, change, turns):
    spec = change(spec, E=2.0, theta=0.1, turns=turns, steps_per_element=48, max_time_step=1e-3)
    energy = simulate(turning_blade, spec).energy
    assert blade_imbalance(energy) < 1e-9
    assert energy.residual < 5e-5
    assert (abs(energy.work_couple) > 100 * 5e-5 * energy.exchanged) == turns


def test_sliding_takes_what_the_rotation_gives_to_it_and_to_the_blade(blade, spec, change):
    """Most of the work against the tangential resistance is lost where it acts: the tip hardly gives way."""
    energy = simulate(blade, change(spec, theta=0.15)).energy
    assert energy.sliding == pytest.approx(energy.work_rotation, rel=0.05)
    assert energy.work_shape > energy.wear * 0.5


def test_rigid_casing_is_touched_and_neither_passed_nor_worn(blade, spec, change):
    spec = change(spec, E=np.inf, K=np.inf, theta=0.0, steps_per_element=12, max_time_step=1e-3)
    result = simulate(blade, spec)
    assert result.status == "completed"
    assert result.n_contact_steps > 100
    assert not result.wear.any()
    assert result.energy.wear == result.energy.stored == 0.0
    assert blade_imbalance(result.energy) < 1e-9
    gap = casing.gap(spec.casing, spec.clearance[0], result.angle)
    position = spec.casing.start_angle + np.arctan2(*blade.node_position[0, 1:]) + result.angle
    ahead = np.interp(position, np.concatenate([result.angle, result.angle + 2 * np.pi]), np.tile(gap, 2))
    over = np.tile(ahead, spec.revolutions) - result.radial_displacement
    assert over.min() > -0.02 * spec.casing.interference  # means over elements, and the tip moves along


def test_start_in_the_first_mode_rings_at_its_frequency(blade, spec, change):
    spec = change(spec, interference=0.0, initial_displacement=-1e-7, revolutions=8)
    result = simulate(blade, spec)
    assert (result.status, result.n_contact_steps, result.wear.any()) == ("completed", 0, False)
    frequency = modes_at(blade, spec.f_omega).omega[0] / (2 * np.pi)
    time = (np.arange(result.radial_displacement.size) + 0.5) / spec.coating.n_elements
    time /= spec.f_omega * blade.f1_hz
    decay = spec.damping_ratio * 2 * np.pi * frequency
    damped = 2 * np.pi * frequency * np.sqrt(1 - spec.damping_ratio**2)
    expected = np.exp(-decay * time) * (np.cos(damped * time) + decay / damped * np.sin(damped * time))
    np.testing.assert_allclose(result.radial_displacement, -1e-7 * expected, rtol=0, atol=2e-10)


def test_wear_loss_is_that_of_the_worn_profile(blade, spec, change):
    """Whatever the way there, an element worn by w has taken σ_Y w + K w²/2 per thickness."""
    spec = change(spec, E=5.0, f_omega=0.05)
    result = simulate(blade, spec)
    area = strip_width(blade)[:, None] * 2 * np.pi * 0.65 / spec.coating.n_elements
    hardening = spec.coating.K * spec.coating.modulus_unit / spec.coating.thickness
    strength = spec.coating.yield_stress * spec.coating.modulus_unit
    expected = area * (strength * result.wear + 0.5 * hardening * result.wear**2)
    assert result.energy.wear == pytest.approx(expected.sum(), rel=1e-6)  # but for half of the last step


def test_unbounded_run_stops_and_keeps_its_data(blade, spec, change):
    whole = simulate(blade, spec)
    limit = 0.5 * np.abs(whole.revolution_peak).max()
    result = simulate(blade, change(spec, displacement_limit=limit))
    assert result.status == "unbounded"
    assert f"{limit:g} m" in result.message
    assert 0 < result.n_steps < whole.n_steps
    done = np.isfinite(result.radial_displacement)
    assert 0 < done.sum() < done.size
    whole_revolutions = done.sum() // spec.coating.n_elements
    assert np.isfinite(result.revolution_amplitude).sum() == whole_revolutions  # by which a run is judged
    assert np.isfinite(result.revolution_peak).sum() == whole_revolutions + 1
    np.testing.assert_array_equal(result.radial_displacement[done], whole.radial_displacement[done])
    assert result.wear.max() > 0
    assert blade_imbalance(result.energy) < 1e-9


def test_a_run_that_ends_in_the_first_step_of_a_contact_has_no_force_of_an_older_one(blade, spec):
    """The force that the condensed modes still bear would count in the elastic energy."""
    _, simulation = set_up(blade, spec)
    state = simulation.state
    state.force[1] = 1e6  # left by a contact before
    state.q[:, 0] = 1.0  # far beyond the limit in the first step
    made = simulation.advance(np.empty(spec.coating.n_elements))
    assert made.n_steps == 0
    assert not state.force[0].any()


@pytest.mark.parametrize("theta", [0.0, 0.15])
@pytest.mark.parametrize("steps", [4, 12, 48])
def test_exponential_scheme_stays_bounded_however_stiff_the_coating(blade, spec, change, steps, theta):
    for stiffer in (1.0, 1e2, 1e4, 1e6):
        stiff = change(spec, E=20 * stiffer, K=10 * stiffer, theta=theta)
        result = simulate(blade, change(stiff, steps_per_element=steps, max_time_step=1e-3, revolutions=3))
        assert result.status == "completed"
        assert result.revolution_peak.max() < 10 * spec.casing.interference


def test_a_run_that_leaves_the_limit_in_its_first_step_has_no_amplitude(blade, spec, change):
    """The casing overlaps with the tip by so much that no step is made: no number, not infinity."""
    casing = {"amplitude": 15e-3, "interference": 15e-3, "start_angle": 0.0}
    deep = change(spec, E=np.inf, K=np.inf, displacement_limit=1e-3, **casing)
    result = simulate(blade, deep)
    assert (result.status, result.n_steps) == ("unbounded", 0)
    for name in ("revolution_peak", "revolution_amplitude", "radial_displacement"):
        assert np.isnan(getattr(result, name)).all()
    assert result.energy.residual == 0.0
