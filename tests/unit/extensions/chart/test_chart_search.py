import numpy as np
import pytest

from bladerub.contact.setup import strip_width
from bladerub.extensions.chart import search
from bladerub.extensions.chart.grid import chart_speeds
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


def test_worn_volume_is_depth_times_area(few_speeds, blade, simulated):
    speeds = chart_speeds(few_speeds)
    point = search.compute(few_speeds, CASE, blade, speeds, np.sqrt(1 + 3 * speeds.f_omega**2))
    depth = 2e-4 * np.linspace(1, 0.5, 8) / np.pi  # the mean of clip(cos, 0) is 1/π
    expected = np.sum(depth * strip_width(blade) * 2 * np.pi * 0.65)
    volume = point.measures["worn_volume"][point.known]
    np.testing.assert_allclose(volume, expected, rtol=1e-5)
    assert np.all(point.measures["deepest_wear"][point.known] == pytest.approx(2e-4, rel=1e-4))
