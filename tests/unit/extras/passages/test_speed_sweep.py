import numpy as np
import pytest
from scipy.integrate import solve_ivp

from bladerub.contact.modes import at_tip, mode_shapes_at
from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.extras.passages.speed_sweep import simulate_sweep, speed_steps
from bladerub.extras.passages.sweep_grid import SweepSpec

N = 200  # elements of the ring


@pytest.mark.parametrize(("start", "end"), [(0.1, 0.3), (0.3, 0.1)])
def test_speed_steps_follow_a_constant_rate(spec, change, start, end):
    run, rate = change(spec, f_omega=start, revolutions=2), 0.5
    plan = speed_steps(SweepSpec(run, end, rate, 0.004), f1_hz=192.0)
    firsts, lasts = [step.first for step in plan], [step.last for step in plan]
    assert firsts == [0, *lasts[:-1]]
    assert lasts[-1] % N == 0
    assert plan[0] == (start, 0, 2 * N)  # where it begins it stays
    revolutions = 192.0 * (start + end) / 2 * abs(end - start) / rate
    assert lasts[-1] / N - 2 == pytest.approx(revolutions, abs=1)
    speeds = np.array([step.f_omega for step in plan[1:]])
    assert np.diff(speeds) == pytest.approx(np.sign(end - start) * 0.004)
    assert np.mean(speeds) == pytest.approx((start + end) / 2)
    little = speed_steps(SweepSpec(change(run, revolutions=0), start + 1e-6, 10.0, 0.004), f1_hz=192.0)
    assert [step[1:] for step in little] == [(0, N)]  # a revolution, though less than an element was swept
    seconds = np.diff([2 * N, *lasts[1:-1]]) / N / (192.0 * speeds[:-1])
    assert seconds == pytest.approx(0.004 / rate, abs=1 / N / 192.0 / 0.1)  # to an element


def test_a_sweep_over_no_range_is_the_run_at_that_speed_and_a_tip_out_of_bounds_ends_it(blade, spec, change):
    run, sweep = simulate(blade, spec), simulate_sweep(blade, SweepSpec(spec, spec.f_omega, 1.0, 1e-3))
    np.testing.assert_array_equal(sweep.radial_displacement, run.radial_displacement)
    np.testing.assert_array_equal(sweep.wear, run.wear)
    np.testing.assert_array_equal(sweep.revolution_amplitude, run.revolution_amplitude)
    assert (sweep.energy, sweep.status, sweep.message) == (run.energy, run.status, run.message)
    assert sweep.work_stiffness == 0
    assert sweep.residual == run.energy.residual
    assert sweep.f_omega == pytest.approx(spec.f_omega)
    assert sweep.time == pytest.approx((np.arange(2) + 0.5) / (192.0 * spec.f_omega))
    run = change(spec, f_omega=0.25, revolutions=0, displacement_limit=3e-4)
    sweep = simulate_sweep(blade, SweepSpec(run, 0.35, 1.0, 1e-3))
    assert sweep.status == "unbounded"
    assert np.isnan(sweep.revolution_amplitude[-1])
    assert np.isfinite(sweep.residual)


@pytest.mark.parametrize("values", [{}, {"scheme": "central_differences", "max_time_step": 5e-6}])
def test_a_change_of_speed_by_nothing_changes_nothing(blade, spec, change, values):
    run = change(spec, revolutions=3, **values)
    whole, little = simulate(blade, run), 1e-12
    rate = little * run.f_omega * 192.0 / 2  # in two revolutions
    passage = SweepSpec(change(run, revolutions=1), run.f_omega + little, rate, little / 8)
    sweep = simulate_sweep(blade, passage)
    assert whole.n_contact_steps > 100
    assert sweep.f_omega.size == 3
    worst = np.abs(sweep.radial_displacement - whole.radial_displacement).max()
    assert worst < 1e-6 * np.abs(whole.radial_displacement).max()
    assert sweep.residual < 2 * whole.energy.residual


def test_free_motion_is_that_of_the_equation_with_stiffness_in_time(blade, spec, change):
    start, end, rate = 0.1, 0.4, 6.0
    away = change(spec, f_omega=start, interference=-0.05, damping_ratio=0.0, revolutions=0)
    away = change(away, initial_displacement=1e-3)
    _, shapes = mode_shapes_at(blade, start)
    rest = shapes[:, 0] * (1e-3 / at_tip(blade, shapes)[0, 0])
    n, inverse = rest.size, 1 / np.diag(blade.mass)

    def motion(time, state):
        force = blade.stiffness(min(start + rate * time, end)) @ state[:n]
        return np.concatenate([state[n:], -inverse * force])

    time, begin = np.linspace(0, (end - start) / rate, 4001), np.concatenate([rest, 0 * rest])
    exact = solve_ivp(motion, time[[0, -1]], begin, "DOP853", time, rtol=1e-8, atol=1e-12)
    tip = at_tip(blade, exact.y[:n])[0]
    turned = 192.0 * (start * time + rate * time**2 / 2)
    errors = []
    for step in (8e-3, 4e-3, 2e-3):
        sweep = simulate_sweep(blade, SweepSpec(away, end, rate, step))
        x = (np.arange(sweep.radial_displacement.size) + 0.5) / N
        within = x < turned[-1]
        errors.append(np.abs(np.interp(x, turned, tip) - sweep.radial_displacement)[within].max() / 1e-3)
    assert errors[2] < 0.01
    assert errors[2] < 0.5 * errors[0]


def test_the_damping_of_free_flights_is_entered_once_at_each_change_of_speed(blade, spec, change):
    away = change(spec, f_omega=0.1, interference=-0.05, revolutions=0, initial_displacement=1e-3)
    sweep = simulate_sweep(blade, SweepSpec(away, 0.4, 6.0, 1e-4))
    own = sweep.energy
    taken = own.kinetic + own.elastic - own.initial + own.damping
    assert taken == pytest.approx(sweep.work_stiffness, abs=1e-4 * own.damping)


def test_the_ledger_closes_though_steps_change_their_angle(blade, spec, change):
    run = change(spec, f_omega=0.15, theta=0.15, revolutions=1, steps_per_element=4, max_time_step=5e-6)
    sweep = SweepSpec(run, 0.3, 20.0, 0.01)
    angles = {set_up(blade, change(run, f_omega=f_omega))[1].angle_per_step for f_omega in (0.15, 0.2, 0.3)}
    assert len(angles) == 3
    result = simulate_sweep(blade, sweep)
    assert result.energy.sliding > 10 * result.energy.wear
    assert result.residual < 2e-3
