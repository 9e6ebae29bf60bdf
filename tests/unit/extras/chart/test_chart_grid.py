import pytest

from bladerub.extras.chart.grid import check
from bladerub.extras.chart.plan import columns
from bladerub.io.errors import BadInput


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
