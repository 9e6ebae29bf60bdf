import itertools

import pytest

from bladerub.extras.chart.grid import check
from bladerub.extras.chart.plan import chart_speeds, columns, expected_minutes, in_words, plan
from bladerub.io.errors import BadInput


@pytest.fixture
def within(config):
    def make(minutes, **keys):
        config["chart"] |= {"minutes": minutes, **keys}
        return plan(config)

    return make


@pytest.mark.parametrize("minutes", [2, 3, 5, 10, 30])
def test_the_forecast_of_a_plan_is_within_its_minutes_and_no_more_fits(config, within, minutes):
    chosen = within(minutes)
    assert expected_minutes(config, chosen) <= minutes
    assert expected_minutes(config, chosen) > 0.75 * minutes
    assert (chosen.E[0], chosen.E[-1]) == (0.05, 50)
    assert (chosen.K[0], chosen.K[-1]) == (0.02, 20)
    found = columns(config)
    assert len(found) == 2 * len(chosen.E)
    assert {len(cases) for cases in found.values()} == {len(chosen.K)}


def test_a_larger_budget_adds_to_a_smaller_one(within):
    plans = [within(minutes) for minutes in (2, 4, 8, 16, 32)]
    for small, large in itertools.pairwise(plans):
        assert set(small.E) <= set(large.E)
        assert set(small.K) <= set(large.K)
        assert len(small.E) * len(small.K) < len(large.E) * len(large.K)


def test_the_whole_chart_comes_first_at_half_of_the_speeds(config, within):
    whole = plan(config)
    assert (whole.multiple, len(whole.E), len(whole.K)) == (1, 24, 24)
    minutes = expected_minutes(config, whole)
    assert within(minutes + 0.1) == whole
    half = chart_speeds(config)
    assert within(minutes - 0.1) == whole._replace(multiple=2)
    fewer = chart_speeds(config)
    assert set(fewer.f_omega[fewer.coarse]) < set(half.f_omega[half.coarse])
    assert within(minutes / 8 - 1, cores=16) == whole._replace(multiple=2)


def test_what_is_planned_is_said(config, within):
    assert in_words(config).startswith("chart: 1,152 of 1,152 coatings; about ")
    chosen = within(10)
    coatings, minutes = 2 * len(chosen.E) * len(chosen.K), expected_minutes(config, chosen)
    assert in_words(config).startswith(
        f"chart: {coatings} of 1,152 coatings, at speeds 2 times as far apart; about {minutes:.1f} min on 2"
    )


def test_minutes_for_less_than_four_coatings_are_refused(within):
    with pytest.raises(BadInput, match=r"chart.minutes = 1: must be at least 1\.\d for the ends"):
        within(1)


def test_a_column_is_all_K_at_one_E_and_theta(config):
    config["chart"] |= {"E": [0.11, 2], "K": [0.5, 5], "theta": [0.15]}
    found = columns(config)
    assert list(found) == ["2nd_E0.11_theta0.15", "2nd_E2_theta0.15"]
    assert [case.name for case in found["2nd_E2_theta0.15"]] == [
        "2nd_E2_K0.5_theta0.15",
        "2nd_E2_K5_theta0.15",
    ]


def test_an_order_without_a_crossing_is_refused(config):
    config["casings"]["2nd"]["peak_orders"] = [4, 6]
    check(config)
    config["speeds"]["stop"] = 0.24
    with pytest.raises(BadInput, match=r"speeds.stop = 0.24: must be at least 0.25 for the chart"):
        check(config)


def test_a_chart_has_speeds_of_the_study(config):
    config["speeds"]["stop"] = 0.3
    config["chart"]["speeds"]["start"] = 0.3
    with pytest.raises(BadInput, match=r"chart.speeds.start = 0.3: must be below speeds.stop = 0.3"):
        check(config)
