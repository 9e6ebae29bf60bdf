import numpy as np
import pytest

from bladerub.study.summary import spectral_peak, summarise


def test_a_steady_run(spec, config, make_result):
    assert summarise(spec, make_result(order=6, amplitude=1e-3, depth=2e-4), config) == {
        "peak_amplitude": pytest.approx(1e-3, rel=1e-4),
        "engine_order": 6.0,
        "max_wear": pytest.approx(2e-4, rel=1e-3),
        "lobes": 6,
        "growth_per_revolution": pytest.approx(0, abs=1e-9),
        "growth_low": pytest.approx(-3e-4, rel=0.2),
        "growth_high": pytest.approx(3e-4, rel=0.2),
        "saturating": False,
        "divergent": False,
        "n_steps": 1000,
        "status": "completed",
    }


def test_a_growing_run(spec, config, make_result):
    summary = summarise(spec, make_result(order=4, growth=0.03), config)
    assert (summary["divergent"], summary["saturating"], summary["status"]) == (True, False, "completed")
    assert summary["growth_per_revolution"] == pytest.approx(0.03)
    assert summary["growth_low"] < 0.03 < summary["growth_high"]
    assert summary["peak_amplitude"] == pytest.approx(1e-3 * 1.03**19, rel=1e-4)


@pytest.mark.parametrize(("order", "found"), [(0.4, 6.0), (0.5, 0.5)])
def test_slow_drift_is_no_vibration(order, found):
    orders = np.arange(100) / 10
    amplitude = np.where(orders == order, 2.0, np.where(orders == 6.0, 1.0, 0.0))
    assert spectral_peak(orders, amplitude) == (found, 1.0 if order < 0.5 else 2.0)


def test_the_peak_is_of_the_last_revolutions(spec, config, make_result):
    decaying = make_result(growth=-0.2)
    summary = summarise(spec, decaying, config)
    assert summary["peak_amplitude"] == pytest.approx(1e-3 * 0.8**10, rel=1e-4)
    assert not summary["divergent"]


def test_an_unbounded_run_is_summed_up_over_what_was_run(spec, config, make_result):
    summary = summarise(spec, make_result(complete=3.5), config)
    assert (summary["divergent"], summary["status"], summary["engine_order"]) == (True, "unbounded", 6.0)
    assert summary["peak_amplitude"] == pytest.approx(1e-3, rel=1e-4)


def test_a_run_without_a_complete_revolution_has_no_engine_order(spec, config, make_result):
    summary = summarise(spec, make_result(complete=0.5), config)
    assert summary["engine_order"] is None
    assert summary["growth_per_revolution"] is summary["growth_low"] is summary["growth_high"] is None


def test_a_blade_that_never_touched(spec, config, make_result):
    summary = summarise(spec, make_result(amplitude=0.0, depth=0.0), config)
    assert summary["engine_order"] is None
    assert (summary["peak_amplitude"], summary["max_wear"], summary["lobes"]) == (0.0, 0.0, 0)
    assert not summary["divergent"]


def test_values_are_plain_python(spec, config, make_result):
    for value in summarise(spec, make_result(), config).values():
        assert not isinstance(value, np.generic)
