import numpy as np
import pytest

from bladerub.extras.chart.grid import chart_orders, chart_speeds, check, columns
from bladerub.extras.plots.chart_moduli import PAPER_E, PAPER_K
from bladerub.io.errors import BadInput


def test_the_chart_is_dense_and_holds_the_paper_s_coatings(config):
    chart = config["chart"]
    assert min(len(chart["E"]), len(chart["K"])) >= 24
    assert (min(chart["E"]), max(chart["E"]), min(chart["K"]), max(chart["K"])) == (0.05, 50, 0.02, 20)
    for values in (chart["E"], chart["K"]):
        assert np.all(np.diff(np.log(values)) > np.log(1.1))
        assert np.all(np.diff(np.log(values)) < np.log(1.6))
    assert set(PAPER_E) <= set(chart["E"])
    assert set(PAPER_K) <= set(chart["K"])


def test_a_column_is_all_K_at_one_E_and_theta(config):
    config["chart"] |= {"E": [0.11, 2], "K": [0.5, 5], "theta": [0.15]}
    found = columns(config)
    assert list(found) == ["2nd_E0.11_theta0.15", "2nd_E2_theta0.15"]
    assert [case.name for case in found["2nd_E2_theta0.15"]] == [
        "2nd_E2_K0.5_theta0.15",
        "2nd_E2_K5_theta0.15",
    ]


def test_speeds_are_the_study_s(config):
    f_omega, uniform, coarse = chart_speeds(config)
    assert np.all(coarse[uniform])
    np.testing.assert_allclose(f_omega[uniform], np.arange(0.152, 0.4001, 0.008))
    dense = f_omega[coarse & (f_omega <= 0.24)]
    np.testing.assert_allclose(dense, np.arange(0.152, 0.2401, 0.004))
    config["speeds"] = {"start": 0.1, "stop": 0.3, "step": 0.1, "extra": [0.197]}
    np.testing.assert_allclose(chart_speeds(config).f_omega[chart_speeds(config).uniform], [0.197, 0.2, 0.3])


def test_orders_are_those_of_the_chart_s_casing(config):
    assert chart_orders(config) == [4, 6]
    config["casings"]["2nd"]["peak_orders"] = [3, 9]
    assert chart_orders(config) == [3, 9]


def test_an_order_without_a_crossing_is_refused(config):
    check(config)
    config["speeds"]["stop"] = 0.24
    with pytest.raises(BadInput, match=r"speeds.stop = 0.24: must be at least 0.25 for the chart"):
        check(config)


def test_an_order_that_crosses_at_the_highest_speed_is_enough(config):
    config["speeds"]["stop"] = 0.25
    check(config)
