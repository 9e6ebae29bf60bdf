import itertools
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from bladerub.extras.chart import stiffening, table
from bladerub.extras.chart.point import read, write
from bladerub.extras.chart.settings import Limits
from bladerub.study.grid import CoatingCase

E, K = (0.5, 1.0, 2.0), (0.1, 1.0, 10.0)


@pytest.fixture
def chart(make_point):
    """Highest at K = 1 for each E; the peak of E = 2 lies between the even speeds."""
    heights = {0.1: 1e-3, 1.0: 2e-3, 10.0: 1.5e-3}
    values = itertools.product(E, K)
    return [make_point(e, k, e * heights[k], f4=0.322 if e == 2 else 0.32, depth=1e-4 * k) for e, k in values]


def test_a_row_sums_up_a_cell_which_comes_back_from_its_file(config, make_point, tmp_path):
    point = make_point(2.0, 1.0, Y4=3e-3, f4=0.33, divergent=1.0)
    point.measures["divergent"][0] = 0.0
    found = table.table(config, [point]).iloc[0]
    assert (found.Y4, found.f4, found.Y6, found.f6) == (3e-3, 0.33, 5e-4, 0.19)
    assert (found.peak, found.f_at_peak, found.deepest_wear) == (3e-3, 0.33, 1e-4)
    assert found.divergent_share == pytest.approx(31 / 32)
    point, path = make_point(1.0, 2.0), tmp_path / "point.h5"
    point.measures["revolutions"][3] = np.nan
    write(path, point, "key", "runs", config)
    again = read(path)
    assert again.case == point.case
    np.testing.assert_array_equal(again.uniform, point.uniform)
    np.testing.assert_array_equal(again.spectrum_amplitude, point.spectrum_amplitude)
    for name, values in point.measures.items():
        np.testing.assert_array_equal(again.measures[name], values)
    assert again.known.sum() == point.f_omega.size - 1


def test_a_chart_without_any_peak_has_tables(config, chart):
    nothing = np.full_like(chart[0].spectrum_amplitude, np.nan)
    unbounded = [replace(point, spectrum_amplitude=nothing) for point in chart]
    ridges, peaks = stiffening.ridges(config, unbounded), stiffening.explanation(config, unbounded)
    assert list(stiffening.ridge_summary(ridges).columns) == stiffening.SUMMARY
    assert (len(ridges), len(peaks), peaks.amplitude.count()) == (0, 2 * len(chart), 0)
    ridges = stiffening.ridges(config, [chart[0], *unbounded[1:]])
    (alone,) = ridges.query("along == 'E' and order == 4 and speed_step < 3e-3").itertuples()
    assert np.isnan([alone.lowest_neighbour, alone.highest_neighbour]).all()


def test_the_ridge_is_the_greatest_of_each_E_and_of_each_K_and_its_explanation_counts_cycles(config, chart):
    ridges = stiffening.ridges(config, chart)
    finest = ridges[(ridges.order == 4) & (ridges.speed_step == 0.002)]
    along = finest[finest.along == "E"].set_index("E")
    assert (along.K == 1.0).all()
    assert (finest[finest.along == "K"].E == 2.0).all()
    assert along.E_T[2.0] == pytest.approx(2 / 3)
    assert along.amplitude[1.0] == pytest.approx(2e-3)
    assert (along.lowest_neighbour[2.0], along.highest_neighbour[2.0]) == pytest.approx((1e-3, 3e-3))
    found = stiffening.ridge_summary(ridges)  # a coarser step loses what lies between
    of_order = found[found.order == 4].set_index("speed_step")
    assert list(of_order.index) == [0.002, 0.004, 0.008]
    assert list(of_order.amplitude) == pytest.approx([4e-3, *2 * [4e-3 * (1 - 0.002 / 0.05)]])
    assert (of_order.K_shift == 1).all()
    assert (of_order.height_lost == 0).all()  # the median: two ridge points of three lie on even speeds
    found = stiffening.explanation(config, chart).set_index(["E", "K", "order"])
    assert found.wear_per_cycle[1.0, 1.0, 4] == pytest.approx(240 / (20 * 4))
    assert found.wear_per_cycle[1.0, 1.0, 6] == pytest.approx(240 / (20 * 6))
    assert found.E_T[1.0, 1.0, 4] == pytest.approx(0.5)
    assert found.f_crossing[1.0, 1.0, 4] == pytest.approx(1 / np.sqrt(13), abs=1e-5)


def test_a_speed_that_follows_the_modulus_does_not_scatter_and_inclined_bars_need_more_of_it(blade):
    # the first mode, axial, takes node 1 off the casing by a fifth of its way along it; the others rest
    axial, radial, tangential = np.eye(3)[0], blade.radial_direction, blade.tangential_direction
    leaning = replace(blade, radial_direction=radial - 0.2 * axial, tangential_direction=tangential + axial)
    # f4 is a function of E_T alone; f6 lies below the crossing where E = 2
    peaks = pd.DataFrame(itertools.product((4, 6), E, K), columns=["order", "E", "K"]).assign(theta=0.0)
    peaks["E_T"] = peaks.E * peaks.K / (peaks.E + peaks.K)
    peaks["f_peak"] = 0.3 + 0.05 * np.tanh(peaks.E_T)
    peaks["f_crossing"] = np.where((peaks.order == 6) & (peaks.E == 2), 0.4, 0.3)
    found = stiffening.table(peaks, leaning)
    assert list(found.below_crossing) == [0, 3]
    of_four = found.set_index("order").loc[4]
    assert of_four.rank_correlation_E_T == pytest.approx(1)
    assert of_four.scatter_E_T == pytest.approx(0, abs=1e-12)
    assert max(of_four.rank_correlation_K, of_four.rank_correlation_E) < 0.95
    peaks["f_peak"] = 0.3 + 0.01 * peaks.E_T
    inclined = peaks.assign(theta=0.15, E_T=3.5 * peaks.E_T)  # the same f_k
    inclined.loc[inclined.f_peak > 0.315, "f_peak"] = 0.4  # beyond what is small
    found = stiffening.table(pd.concat([peaks, inclined]), leaning)
    assert list(found[found.order == 4].modulus_ratio) == pytest.approx([1, 3.5])
    share = np.cos(0.15) - np.sin(0.15) / 0.2  # by the lean of the first mode
    assert stiffening.share(leaning, 0.15, 0.2) == pytest.approx(share)
    expected = 1 / stiffening.share(leaning, 0.15, 0.3)
    assert list(found[found.order == 4].modulus_ratio_by_share) == pytest.approx([1, expected])


def test_the_recommended_coating_says_how_good_those_next_to_it_are_and_nothing_betters_the_front(
    config, chart
):
    rows = table.table(config, chart)
    (soft,) = table.recommended(rows, Limits(amplitude=1.6e-3, wear=5e-4)).to_dict("records")
    assert (soft["E"], soft["K"], soft["safe"], soft["coatings"]) == (0.5, 0.1, True, 9)
    assert np.isnan([soft["E_below"], soft["K_below"]]).all()
    assert (soft["E_above"], soft["K_above"]) == (1.0, 1.0)
    assert (soft["neighbours"], soft["safe_neighbours"]) == (3, 2)
    assert (soft["lowest_neighbour"], soft["highest_neighbour"]) == pytest.approx((1e-3, 2e-3))
    (none,) = table.recommended(rows, Limits(amplitude=1e-5, wear=1e-3)).to_dict("records")
    assert (none["safe"], none["broken"], none["safe_coatings"]) == (False, 1, 0)
    chart = pd.DataFrame({"theta": [0.0, 0.0, 0.0, 0.0, 0.15], "peak": [1e-3, 2e-3, 3e-3, 2e-3, 9e-3]})
    chart = chart.assign(worn_volume=[5.0, 3.0, 4.0, 3.5, 9.0], divergent_share=0.0)
    chart["deepest_wear"] = [1e-4, 9e-4, 1e-4, 1e-4, 1e-4]
    limits = Limits(amplitude=5e-3, wear=5e-4, divergent_share=0.0)
    front = table.pareto(chart, limits)
    assert list(front.peak) == [1e-3, 2e-3, 9e-3]
    assert list(front.safe) == [True, False, False]
    broken = table.broken_limits(chart, limits)
    assert list(broken.wear) == [False, True, False, False, False]
    assert list(broken.amplitude) == [False] * 4 + [True]
    stressed = chart.assign(alternating=[np.nan, 3e8, 1e8, 1e8, 1e8])  # not known of the first
    assert list(table.broken_limits(stressed, Limits(fatigue=2e8)).fatigue) == [True] * 2 + [False] * 3


def test_the_search_is_put_to_the_study(config, make_map):
    f_omega = np.sort([*np.round(np.arange(0.02, 0.4001, 0.002), 6), 0.197])
    hats = {4: (0.322, 2e-3), 6: (0.19, 1e-3)}
    maps = [make_map(CoatingCase("2nd", e, 0.5, 0.0), hats, f_omega) for e in E]
    maps[1].spectrum_amplitude[f_omega == 0.274, 40] = 3e-3  # a spike that no local maximum leads to
    found = table.placement(config, maps)
    spike = (found.E == 1.0) & (found.quantity == "Y4")
    assert (found.missed[~spike] == 0).all()
    assert found.missed[spike].item() == pytest.approx(1 / 3)
    counts = table.placement_summary(found).set_index("quantity")
    assert tuple(counts.loc["Y4", ["coatings", "exact", "within_5_percent"]]) == (3, 2, 2)
    assert counts.worst_missed["Y4"] == pytest.approx(1 / 3)
    assert (counts.exact[["Y6", "peak"]] == 3).all()
