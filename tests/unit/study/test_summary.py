import numpy as np
import pytest

from bladerub.study.grid import CoatingCase
from bladerub.study.store import stored_run
from bladerub.study.summary import spectral_peak, summarise


@pytest.fixture
def summed_up(spec, config):
    """The summary of a result, as of the study's config."""

    def of(result, longer=None):
        case, analysis = CoatingCase("2nd", 2.0, 0.5, 0.0), config["analysis"]
        stored = [each and stored_run(case, spec, each, "key", analysis, False) for each in (result, longer)]
        return summarise(stored[0], analysis, stored[1])

    return of


def test_a_steady_run(summed_up, make_result):
    assert summed_up(make_result(order=6, amplitude=1e-3, depth=2e-4)) == {
        "peak_amplitude": pytest.approx(1e-3, rel=1e-4),
        "engine_order": 6.0,
        "max_wear": pytest.approx(2e-4, rel=1e-3),
        "lobes": 6,
        "wear_harmonic": 6,
        "wear_harmonic_share": pytest.approx(0.84, abs=0.01),
        "growth_per_revolution": pytest.approx(0, abs=1e-9),
        "growth_low": pytest.approx(-3e-4, rel=0.2),
        "growth_high": pytest.approx(3e-4, rel=0.2),
        "saturating": False,
        "divergent": False,
        "growth_revolutions": 20,
        "energy_residual": pytest.approx(1.23, abs=0.01),  # of the stand-in
        "n_steps": 1000,
        "status": "completed",
    }


def test_a_growing_run(summed_up, make_result):
    summary = summed_up(make_result(order=4, growth=0.03))
    assert (summary["divergent"], summary["saturating"], summary["status"]) == (True, False, "completed")
    assert summary["growth_per_revolution"] == pytest.approx(0.03)
    assert summary["growth_low"] < 0.03 < summary["growth_high"]
    assert summary["peak_amplitude"] == pytest.approx(1e-3 * 1.03**19, rel=1e-4)


@pytest.mark.parametrize(("order", "found"), [(0.4, 6.0), (0.5, 0.5)])
def test_slow_drift_is_no_vibration(order, found):
    orders = np.arange(100) / 10
    amplitude = np.where(orders == order, 2.0, np.where(orders == 6.0, 1.0, 0.0))
    assert spectral_peak(orders, amplitude) == (found, 1.0 if order < 0.5 else 2.0)
