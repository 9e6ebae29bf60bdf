import itertools
from dataclasses import replace

import numpy as np
import pytest
from study_fixtures import changed

from bladerub.contact.strips import strip_width
from bladerub.extras.chart import column, search
from bladerub.extras.chart.plan import chart_speeds, check, columns, expected_minutes, in_words, plan
from bladerub.extras.chart.point import PointRow, nearest_speeds
from bladerub.extras.chart.table import read_points
from bladerub.io.errors import BadInput, DamagedFile
from bladerub.study.cache import ARCHIVE
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import read_manifest, write_manifest

CASE = CoatingCase("2nd", 2.0, 0.5, 0.0)


@pytest.fixture
def simulated():
    return []


@pytest.fixture
def solve(make_result, simulated):
    """Stand in for the solver, in another order: highest at 0.28, growing at 0.16 and 0.28."""

    def solved(specs):
        simulated.extend((spec.f_omega, spec.revolutions) for spec in specs)
        for number, spec in reversed(list(enumerate(specs))):
            growth = 0.05 if spec.f_omega in (0.16, 0.28) else 0.0
            order = 6.0 if spec.f_omega < 0.25 else 4.0
            height = 1e-3 * (1 - 2 * abs(spec.f_omega - 0.28))
            yield number, make_result(spec.revolutions, order=order, amplitude=height, growth=growth), 0.0

    return solved


@pytest.fixture
def start(few_speeds, blade):
    return lambda speeds, case=CASE, earlier=None: search.search(
        few_speeds, case, blade, speeds, np.sqrt(1 + 3 * speeds.f_omega**2), earlier
    )


@pytest.fixture
def on(start, solve):
    return lambda *about: next(search.compute({CASE: start(*about)}, solve))[1]


def assert_same(point, other):
    np.testing.assert_array_equal(point.spectrum_amplitude, other.spectrum_amplitude)
    for name, values in other.measures.items():
        np.testing.assert_array_equal(point.measures[name], values)


def test_the_search_encloses_the_peaks_and_judges_even_speeds_alone(few_speeds, on, simulated):
    speeds = chart_speeds(few_speeds)
    np.testing.assert_allclose(speeds.f_omega[speeds.coarse], [0.16, 0.24, 0.32])
    point = on(speeds)
    runs = [f_omega for f_omega, revolutions in simulated if revolutions == 20]
    assert runs[:3] == [0.16, 0.24, 0.32]
    assert sorted(runs) == list(point.f_omega[point.known])
    assert {0.26, 0.28, 0.3} <= set(runs)
    assert [f_omega for f_omega, revolutions in simulated if revolutions == 60] == [0.16]
    judged = dict(zip(point.f_omega, point.measures["divergent"], strict=True))
    assert (judged[0.16], judged[0.24], judged[0.32]) == (1.0, 0.0, 0.0)
    assert np.isnan(judged[0.28])


def test_searches_together_are_those_alone(few_speeds, start, on, solve):
    speeds = chart_speeds(few_speeds)
    cases = [CASE, replace(CASE, E=5.0)]
    asked = []

    def counted(specs):
        asked.append(len(specs))
        return solve(specs)

    together = dict(search.compute({case: start(speeds, case) for case in cases}, counted))
    for case in cases:
        assert_same(together[case], on(speeds, case))
    assert asked[0] == 2 * speeds.coarse.sum()  # both at once
    assert asked[-1] == 2  # the longer runs of those that grow, in the end


def test_a_search_from_more_speeds_computes_what_an_earlier_one_did_not(few_speeds, on, simulated):
    speeds, far = chart_speeds(few_speeds), nearest_speeds(few_speeds, 2)
    earlier = on(far)
    simulated.clear()
    whole = on(speeds)
    needed = len(simulated)
    simulated.clear()
    again = on(speeds, CASE, earlier)
    assert len(simulated) < needed
    # runs that the earlier search found beside its even speeds were not judged there
    known = set(speeds.f_omega[earlier.known & ~(speeds.uniform & ~far.uniform)])
    assert not known & {f_omega for f_omega, _ in simulated}
    assert_same(again, whole)
    fewer = on(far, CASE, whole)  # judges its own even speeds alone
    np.testing.assert_array_equal(fewer.measures["divergent"], earlier.measures["divergent"])


def test_each_measure_is_that_of_its_run(few_speeds, make_result, blade, start):
    result = make_result(order=4.0, amplitude=1e-3)
    result = replace(result, revolution_peak=result.revolution_peak + np.linspace(0, 1e-3, 20))
    searches = {CASE: start(chart_speeds(few_speeds))}
    ((_, point),) = search.compute(searches, lambda specs: [(i, result, 0.0) for i in range(len(specs))])
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
    known = np.zeros(curve.size, dtype=bool)
    known[::step] = True
    while new := search.next_speeds(known, [np.where(known, curve, np.nan)], share):
        assert not known[new].any()
        known[new] = True
    return known


def test_a_smooth_maximum_is_enclosed_and_a_lower_one_looked_at_only_from_the_share_on():
    curve = -np.abs(np.arange(65) - 21.0) + 100
    known = looked_at(curve, 8, share=1.0)
    assert known[20:23].all()
    assert known.sum() <= 9 + 7
    place = np.arange(65)
    hidden = 50 + 60.0 * (place == 47) + 20 * np.clip(1 - np.abs(place - 48) / 4, 0, None)  # 70 at its sample
    curve = np.where(place > 40, hidden, 100 - 2 * np.abs(place - 16.0))
    assert not looked_at(curve, 8, share=0.9)[47]
    assert looked_at(curve, 8, share=0.6)[47]


@pytest.fixture
def within(config):
    return lambda minutes, **keys: changed(config, chart={"minutes": minutes, **keys})


def test_the_forecast_of_a_plan_is_within_its_minutes_and_a_larger_budget_adds_to_a_smaller_one(within):
    plans = []
    for minutes in (2, 4, 8, 20):
        config = within(minutes)
        plans.append(chosen := plan(config))
        assert 0.75 * minutes < expected_minutes(config, chosen) <= minutes
        assert (chosen.E[0], chosen.E[-1]) == (0.05, 50)
        assert (chosen.K[0], chosen.K[-1]) == (0.02, 20)
        assert [len(cases) for cases in columns(config).values()] == 2 * len(chosen.E) * [len(chosen.K)]
    for small, large in itertools.pairwise(plans):
        assert set(small.E) <= set(large.E)
        assert set(small.K) <= set(large.K)
        assert len(small.E) * len(small.K) < len(large.E) * len(large.K)
    with pytest.raises(BadInput, match=r"chart.minutes = 0.5: must be at least 0\.\d for the ends"):
        plan(within(0.5))


def test_the_whole_chart_comes_first_at_half_of_the_speeds(config, within):
    whole = plan(config)
    assert (whole.multiple, len(whole.E), len(whole.K)) == (1, 24, 24)
    minutes = expected_minutes(config, whole)
    assert plan(within(minutes + 0.1)) == whole
    shorter = within(minutes - 0.1)
    assert plan(shorter) == plan(within(minutes / 8 - 0.8, cores=16)) == whole._replace(multiple=2)
    assert "2 times as far apart" in in_words(shorter)
    half, fewer = chart_speeds(config), chart_speeds(shorter)
    assert set(fewer.f_omega[fewer.coarse]) < set(half.f_omega[half.coarse])


def test_a_chart_has_speeds_of_the_study_and_crossings_of_its_orders_and_columns_of_all_K(config):
    config = changed(config, casings={"2nd": {"peak_orders": [4, 6]}})
    check(config)
    with pytest.raises(BadInput, match=r"speeds.stop = 0.24: must be at least 0.25 for the chart"):
        check(config.replaced("speeds.stop", 0.24))
    with pytest.raises(BadInput, match=r"chart.speeds.start = 0.3: must be below speeds.stop = 0.3"):
        check(config.replaced("speeds.stop", 0.3).replaced("chart.speeds.start", 0.3))
    found = columns(changed(config, chart={"E": [0.11, 2], "K": [0.5, 5], "theta": [0.15]}))
    assert list(found) == ["2nd_E0.11_theta0.15", "2nd_E2_theta0.15"]
    assert [(case.E, case.K) for case in found["2nd_E2_theta0.15"]] == [(2, 0.5), (2, 5)]


@pytest.fixture
def build(few_speeds, blade, make_point, monkeypatch, tmp_path):
    """Compute the column of given K, write its manifest and return the K that the search was asked for."""
    computed = []

    def compute(searches, solve):
        for case in searches:
            computed.append(case.K)
            yield case, make_point(case.E, case.K)

    monkeypatch.setattr(column, "compute", compute)

    def run(K, digest="blade", growth=0.01):
        config = few_speeds.replaced("analysis.divergence.growth", growth)
        config = config.replaced("chart", config.chart.model_copy(update={"E": [2], "K": K, "theta": [0.0]}))
        computed.clear()
        ((name, cases),) = columns(config).items()
        plan = column.plan_column(config, cases)
        rows = column.compute_missing(config, plan, blade, tmp_path / "cells", digest, lambda line: None)
        write_manifest(tmp_path / "columns" / f"{name}.tsv", rows, PointRow)
        return list(computed)

    return run


MANIFEST = "columns/2nd_E2_theta0.tsv"


def test_a_column_computes_what_is_not_there(build, tmp_path):
    manifest = tmp_path / MANIFEST
    assert build([0.5, 5]) == [0.5, 5]
    rows = read_manifest(manifest, PointRow)
    assert [row.file for row in rows] == ["2nd_E2_K0.5_theta0.h5", "2nd_E2_K5_theta0.h5"]
    assert build([0.5, 5]) == []
    assert build([0.5, 1, 5]) == [1]
    (tmp_path / "cells" / rows[1].file).write_bytes(b"")
    assert build([0.5, 5]) == [5]
    assert build([5], growth=0.02) == [5]


def test_a_change_of_mind_costs_no_point_and_no_table_is_made_of_a_damaged_one(build, tmp_path):
    manifest = tmp_path / MANIFEST
    build([0.5, 5])
    contents = {path.name: path.read_bytes() for path in (tmp_path / "cells").glob("*.h5")}
    rows = read_manifest(manifest, PointRow)
    assert build([0.5, 5], digest="another blade") == [0.5, 5]
    assert build([0.5, 5]) == build([0.5, 5], digest="another blade") == build([0.5, 5]) == []
    assert read_manifest(manifest, PointRow) == rows
    assert {path.name: path.read_bytes() for path in (tmp_path / "cells").glob("*.h5")} == contents
    assert len(list((tmp_path / "cells" / ARCHIVE).iterdir())) == 2
    assert [point.case.K for point in read_points([manifest])] == [0.5, 5]
    path = tmp_path / "cells" / "2nd_E2_K5_theta0.h5"
    content = bytearray(path.read_bytes())
    content[-1] ^= 1
    path.write_bytes(content)
    with pytest.raises(DamagedFile, match="K5"):
        list(read_points([manifest]))
    path.unlink()
    with pytest.raises(FileNotFoundError, match="K5"):
        list(read_points([manifest]))


def test_settings_coatings_and_sources_that_shape_a_point_count_for_its_key(few_speeds, monkeypatch):
    config = changed(few_speeds, chart={"speeds": {"dense_stop": 0.24, "dense_step": 0.04}})

    def digest(case=CASE, config=config):
        return column.determinants(config, case, chart_speeds(config))

    own = digest()
    for path, value in (
        ("analysis.lobe_prominence", 0.3),
        ("analysis.peaks.speed_window", [0.8, 1.2]),
        ("analysis.divergence.growth", 0.011),
        ("chart.speeds.refine_above", 0.51),
        ("chart.speeds.dense_stop", 0.32),
        ("speeds.extra", [0.197]),
        ("solver.revolutions", 21),
    ):
        assert digest(config=config.replaced(path, value)) != own, path
    others = [replace(CASE, E=3.0), replace(CASE, K=1.0), replace(CASE, theta=0.1)]
    others += [replace(CASE, casing="2nd5nd"), replace(CASE, law="coulomb")]
    found = {digest(case) for case in [CASE, *others]}
    other = {"chart": {"E": [7, 8], "K": [8, 9], "limits": {"wear": 1e-9}}, "results": "elsewhere"}
    other |= {"analysis": {"max_order": 9, "histories": []}, "figures": {"dpi": 50}}
    other |= {"coatings": [{"casing": "2nd", "coating": "rigid", "friction": [0.0]}]}
    elsewhere = changed(config, casings={"2nd5nd": {"peak_orders": [5]}}, **other)
    assert digest(config=elsewhere) == own  # what acts elsewhere leaves it
    for source in ("solver_digest", "chart_digest"):
        monkeypatch.setattr(column, source, lambda: "other")
        found.add(digest())
    assert len(found) == 8
    assert digest(config=changed(config, casings={"2nd": {"peak_orders": [2]}})) not in found
