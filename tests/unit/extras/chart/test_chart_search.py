from dataclasses import replace

import numpy as np
import pytest

from bladerub.contact.setup import strip_width
from bladerub.extras.chart import search
from bladerub.extras.chart.grid import nearest_speeds
from bladerub.extras.chart.plan import chart_speeds
from bladerub.extras.chart.search import next_speeds
from bladerub.study.grid import CoatingCase

CASE = CoatingCase("2nd", 2.0, 0.5, 0.0)


@pytest.fixture
def simulated(monkeypatch, make_result):
    """Stand in for the solver: highest at 0.28, growing at 0.16 and 0.28; lists speeds and revolutions."""
    asked = []

    def simulate(blade, spec):
        asked.append((spec.f_omega, spec.revolutions))
        growth = 0.05 if spec.f_omega in (0.16, 0.28) else 0.0
        order = 6.0 if spec.f_omega < 0.25 else 4.0
        height = 1e-3 * (1 - 2 * abs(spec.f_omega - 0.28))
        return make_result(revolutions=spec.revolutions, order=order, amplitude=height, growth=growth)

    monkeypatch.setattr(search, "simulate", simulate)
    return asked


def test_the_search_encloses_the_peaks_and_judges_even_speeds_alone(few_speeds, blade, simulated):
    speeds = chart_speeds(few_speeds)
    np.testing.assert_allclose(speeds.f_omega[speeds.coarse], [0.16, 0.24, 0.32])
    point = search.compute(few_speeds, CASE, blade, speeds, np.sqrt(1 + 3 * speeds.f_omega**2))
    runs = [f_omega for f_omega, revolutions in simulated if revolutions == 20]
    assert runs[:3] == [0.16, 0.24, 0.32]
    assert sorted(runs) == list(point.f_omega[point.known])
    assert {0.26, 0.28, 0.3} <= set(runs)
    assert [f_omega for f_omega, revolutions in simulated if revolutions == 60] == [0.16]
    judged = dict(zip(point.f_omega, point.measures["divergent"], strict=True))
    assert (judged[0.16], judged[0.24], judged[0.32]) == (1.0, 0.0, 0.0)
    assert np.isnan(judged[0.28])


def test_searches_together_are_those_alone(few_speeds, blade, simulated):
    speeds = chart_speeds(few_speeds)
    C1 = np.sqrt(1 + 3 * speeds.f_omega**2)
    cases = [CASE, replace(CASE, E=5.0)]
    asked = []

    def solve(specs):
        asked.append(len(specs))
        return ((i, search.simulate(blade, specs[i])) for i in reversed(range(len(specs))))  # in any order

    searches = {case: search.search(few_speeds, case, blade, speeds, C1) for case in cases}
    together = dict(search.compute_together(searches, solve))
    for case in cases:
        alone = search.compute(few_speeds, case, blade, speeds, C1)
        np.testing.assert_array_equal(together[case].spectrum_amplitude, alone.spectrum_amplitude)
        for name, values in alone.measures.items():
            np.testing.assert_array_equal(together[case].measures[name], values)
    assert asked[0] == 2 * speeds.coarse.sum()  # both at once
    assert asked[-1] == 2  # the longer runs of those that grow, in the end


def test_a_search_from_more_speeds_computes_what_an_earlier_one_did_not(few_speeds, blade, simulated):
    speeds = chart_speeds(few_speeds)
    C1 = np.sqrt(1 + 3 * speeds.f_omega**2)
    far = nearest_speeds(few_speeds, 2)
    earlier = search.compute(few_speeds, CASE, blade, far, C1)
    simulated.clear()
    whole = search.compute(few_speeds, CASE, blade, speeds, C1)
    needed = len(simulated)
    simulated.clear()
    again = search.compute(few_speeds, CASE, blade, speeds, C1, earlier)
    assert len(simulated) < needed
    # runs that the earlier search found beside its even speeds were not judged there
    known = set(speeds.f_omega[earlier.known & ~(speeds.uniform & ~far.uniform)])
    assert not known & {f_omega for f_omega, _ in simulated}
    np.testing.assert_array_equal(again.spectrum_amplitude, whole.spectrum_amplitude)
    for name, values in whole.measures.items():
        np.testing.assert_array_equal(again.measures[name], values)
    fewer = search.compute(few_speeds, CASE, blade, far, C1, whole)  # judges its own even speeds alone
    np.testing.assert_array_equal(fewer.measures["divergent"], earlier.measures["divergent"])


def test_each_measure_is_that_of_its_run(few_speeds, make_result, blade, monkeypatch):
    result = make_result(order=4.0, amplitude=1e-3)
    result = replace(result, revolution_peak=result.revolution_peak + np.linspace(0, 1e-3, 20))
    monkeypatch.setattr(search, "simulate", lambda *_: result)
    speeds = chart_speeds(few_speeds)
    point = search.compute(few_speeds, CASE, blade, speeds, np.sqrt(1 + 3 * speeds.f_omega**2))
    f_omega, of = point.f_omega[point.known], {k: v[point.known] for k, v in point.measures.items()}
    assert of["peak"] == pytest.approx(2e-3, rel=1e-4)
    assert of["lobes"] == pytest.approx(4)
    assert (of["unbounded"] == 0).all()
    assert of["revolutions"] == pytest.approx(1000 * 2e-7 * f_omega * blade.f1_hz)
    for name in ("damping", "wear", "sliding"):
        assert (of[f"energy_{name}"] == getattr(result.energy, name)).all()
    np.testing.assert_allclose(point.spectrum_amplitude[point.known, 0], 1e-3, rtol=1e-3)
    assert (point.spectrum_amplitude[point.known, 1] < 1e-6).all()
    depth = 2e-4 * np.linspace(1, 0.5, 8) / np.pi  # the mean of clip(cos, 0) is 1/π
    assert of["worn_volume"] == pytest.approx(np.sum(depth * strip_width(blade) * 2 * np.pi * 0.65), rel=1e-5)
    assert of["deepest_wear"] == pytest.approx(2e-4, rel=1e-4)


def looked_at(curve, step, share):
    """Run a looked_at on a curve that is known everywhere: which speeds it looks at."""
    known = np.zeros(curve.size, dtype=bool)
    known[::step] = True
    while new := next_speeds(known, [np.where(known, curve, np.nan)], share):
        assert not known[new].any()
        known[new] = True
    return known


def test_a_smooth_maximum_is_enclosed_by_its_neighbours():
    curve = -np.abs(np.arange(65) - 21.0) + 100
    known = looked_at(curve, 8, share=1.0)
    assert known[20:23].all()
    assert known.sum() <= 9 + 7


def test_a_lower_maximum_is_looked_at_only_from_the_share_on():
    place = np.arange(65)
    hidden = 50 + 60.0 * (place == 47) + 20 * np.clip(1 - np.abs(place - 48) / 4, 0, None)  # 70 at its sample
    curve = np.where(place > 40, hidden, 100 - 2 * np.abs(place - 16.0))
    assert not looked_at(curve, 8, share=0.9)[47]
    assert looked_at(curve, 8, share=0.6)[47]
