import math
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from bladerub.contact.law import element
from bladerub.contact.modes import Modes
from bladerub.contact.setup import time_step
from bladerub.contact.steps import with_steps
from bladerub.contact.strips import element_area
from bladerub.extras.verification import impact, refinement, rigid_casing
from bladerub.study.grid import run_spec
from bladerub.study.peaks import COLUMNS


def test_tip_coating_and_step_stay_the_same(blade, config, case):
    own = with_steps(run_spec(config, case, 0.3), 20)
    finer = refinement.with_finer_bars(blade, own, 4)
    assert finer.coating.n_elements == 4 * own.coating.n_elements
    assert finer.tip.half_width == pytest.approx(4 * own.tip.half_width)
    assert finer.tip.curvature * 16 == pytest.approx(own.tip.curvature)  # elements are a quarter as wide
    assert time_step(blade, finer) == pytest.approx(time_step(blade, own))
    elastic = [element(spec.coating, element_area(blade, spec)).elastic for spec in (own, finer)]
    np.testing.assert_allclose(4 * elastic[1], elastic[0])


def test_the_peak_is_followed_and_compared_with_that_of_the_study(blade, config, make_result, monkeypatch):
    n = config.contact.elements

    def simulate(_, spec):
        finer = spec.coating.n_elements // n
        peak = {1: 0.31, 2: 0.314, 4: 0.314}[finer]
        result = make_result(amplitude=1e-3 * (1 - abs(spec.f_omega - peak)) / min(finer, 2), depth=1e-4)
        return replace(result, wear=np.repeat(result.wear, finer, axis=1) * finer)

    monkeypatch.setattr(refinement, "simulate", simulate)
    of_all = [(0.5, 0.15, "theta"), (0.5, 0.15, "coulomb"), (1.0, 0.0, "theta")]
    rows = [["2nd", 2.0, K, theta, 6, 0.31, 1e-3, law] for K, theta, law in of_all]
    bars = refinement.finer_bars(blade, config, pd.DataFrame(rows, columns=COLUMNS))
    assert bars.elements.tolist() == [n, 2 * n, 4 * n]  # of the listed coating alone
    assert bars.f_peak.tolist() == [0.31, 0.314, 0.314]
    np.testing.assert_allclose(bars.amplitude_change, [0, -0.5, -0.5], atol=1e-9)
    np.testing.assert_allclose(bars.volume_change, [0, 1, 3], atol=1e-9)
    np.testing.assert_allclose(bars.wear_difference, [0, 1, 3], atol=1e-9)


def test_all_coatings_are_listed_and_each_peak_and_a_plain_speed_is_compared_with_the_study(
    blade, config, make_result, monkeypatch
):
    of_all = [(0.0, 4, 0.31, "theta"), (0.0, 6, 0.19, "theta"), (math.nan, 6, 0.19, "coulomb")]
    rows = [("bumps", 1.0, 0.5, theta, order, f_peak, 1e-3, law) for theta, order, f_peak, law in of_all]
    found = refinement.listed(pd.DataFrame(rows, columns=COLUMNS))
    assert [(case.casing, peak.f_peak) for case, peak in found] == [("bumps", 0.31), ("bumps", 0.19)]

    def simulate(_, spec, modes, how):
        return make_result(amplitude=2e-3 if how.treatment == "massless" else 1e-3, depth=0.0), how.finer

    monkeypatch.setattr(rigid_casing, "_simulate", simulate)
    rows = [["2nd", math.inf, math.inf, 0.0, 4, 0.388, 1e-3, "coulomb"]]
    rows += [["2nd", 2.0, 0.5, 0.0, 4, 0.3, 1e-3, "theta"]]
    table = rigid_casing.table(blade, config, pd.DataFrame(rows, columns=COLUMNS))
    assert sorted(table.f_omega.unique()) == [0.25, 0.384, 0.386, 0.388, 0.39, 0.392]
    assert set(table.order) == {4}
    own = table[(table.treatment == "exponential") & (table.steps == 1)]
    np.testing.assert_allclose(own.amplitude_change, 0, atol=1e-12)
    massless = table[table.treatment == "massless"]
    np.testing.assert_allclose(massless.amplitude_change, 1, atol=1e-9)
    assert massless.complete.all()
    assert not table[(table.treatment == "moreau_jean_0") & (table.modes == 10)].complete.any()


impact._march.enable_caching()  # as in test_blade_rotor37.py: one of both compiles it
OMEGA, DISTANCE = 2 * np.pi * 50.0, 1e-3
MODES = Modes(np.array([OMEGA]), np.repeat([[1.0], [0.0]], 8, axis=0), 8)


@pytest.fixture
def run(blade, spec):
    """A run of a blade that moves as a whole against a round casing which it touches at rest."""
    round_one = {"nodal_diameters": (2,), "weights": (1.0,), "amplitude": 1e-14, "interference": 0.0}
    casing = replace(spec.casing, **round_one)
    f_omega = 10.0 / blade.f1_hz  # ten turns a second: one has five periods
    values = {"f_omega": f_omega, "revolutions": 1, "steps_per_element": 20, "clearance": (0.0, 0.0)}
    return replace(spec, casing=casing, initial_displacement=-DISTANCE, **values)


def turning_points(motion):
    u = motion.radial_displacement
    low = (u[1:-1] < u[:-2]) & (u[1:-1] <= u[2:]) & (u[1:-1] < -1e-6)
    return -u[1:-1][low]


@pytest.mark.parametrize("restitution", [0.0, 0.5, 1.0])
def test_each_impact_keeps_its_share_of_the_velocity(run, blade, restitution):
    rule = impact.moreau_jean(MODES, 0.0, impact.time_step(blade, run), restitution)
    motion = impact.simulate(rule, blade, run)
    if restitution == 0:  # it stays at the wall
        half = motion.radial_displacement.size // 2
        assert np.abs(motion.radial_displacement[half:]).max() < 0.01 * DISTANCE
    else:  # and has twice as many flights as without it
        expected = DISTANCE * restitution ** np.arange(1, 9)
        np.testing.assert_allclose(turning_points(motion)[:8], expected, rtol=0.03)


def test_a_stiff_spring_returns_the_velocity(run, blade):
    run = replace(run, steps_per_element=400)  # the force acts at the end of a step: it damps
    rule = impact.penalty(MODES, 0.0, impact.time_step(blade, run), 50 * OMEGA**2)
    found = turning_points(impact.simulate(rule, blade, run))
    np.testing.assert_allclose(found[:8], DISTANCE, rtol=0.03)
