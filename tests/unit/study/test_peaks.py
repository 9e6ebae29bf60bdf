import numpy as np
import pytest

from bladerub.study import peaks
from bladerub.study.grid import CoatingCase

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)


@pytest.fixture
def settings(config):
    return config["analysis"]["peaks"] | {"order_halfwidth": 0.25, "speed_window": [0.85, 1.25]}


@pytest.mark.parametrize("order", [4, 5, 6])
def test_the_crossing_is_where_the_engine_order_meets_c1(make_map, order):
    fine = make_map(CASE, {}, np.linspace(0.02, 0.4, 400))
    exact = 1 / np.sqrt(order**2 - 3)  # of C1² = 1 + 3 f²
    assert peaks.crossing_speed(fine, order) == pytest.approx(exact, abs=1e-6)
    assert peaks.crossing_speed(make_map(CASE, {}), order) == pytest.approx(exact, abs=1e-4)


def test_the_peak_is_the_largest_amplitude_on_the_order_near_the_crossing(make_map, settings):
    coating = make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 5e-4)})
    assert peaks.peak(coating, 4, settings) == peaks.Peak(0.3, pytest.approx(2e-4))
    assert peaks.peak(coating, 6, settings) == peaks.Peak(0.2, pytest.approx(5e-4))


def test_larger_amplitudes_off_the_order_or_outside_the_window_do_not_count(make_map, settings):
    crossing = 1 / np.sqrt(33)  # order 6
    coating = make_map(CASE, {6: (0.2, 1e-4), 6.5: (0.2, 9e-4), 5.7: (0.19, 9e-4)})
    coating.spectrum_amplitude[coating.f_omega > 1.25 * crossing, 60] = 9e-4
    coating.spectrum_amplitude[coating.f_omega < 0.85 * crossing, 60] = 9e-4
    assert peaks.peak(coating, 6, settings) == peaks.Peak(0.2, pytest.approx(1e-4))


@pytest.mark.parametrize(("halfwidth", "counts"), [(0.19, False), (0.2, True), (0.21, True)])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_line_at_the_halfwidth_belongs_to_the_order(make_map, halfwidth, counts, side):
    coating = make_map(CASE, {6: (0.2, 1e-4), 6 + 0.2 * side: (0.2, 9e-4)})
    found = peaks.order_amplitude(coating, 6, halfwidth)[coating.f_omega == 0.2]
    assert found == pytest.approx(9e-4 if counts else 1e-4)


def test_runs_without_a_spectrum_are_passed_over(make_map, settings):
    coating = make_map(CASE, {6: (0.2, 1e-4)})
    coating.spectrum_amplitude[np.isclose(coating.f_omega, 0.2)] = np.nan
    assert peaks.peak(coating, 6, settings).f_omega in (0.19, 0.21)


def test_a_missing_peak_has_a_reason(make_map, settings):
    unbounded = make_map(CASE, {})
    unbounded.spectrum_amplitude[(unbounded.f_omega > 0.1) & (unbounded.f_omega < 0.25)] = np.nan
    for coating, order, reason, nearest in (
        (make_map(CASE, {}, [0.05, 0.1, 0.3]), 6, "no run between", 0.1),
        (unbounded, 6, "none of the 7 runs between", 0.17),
        (make_map(CASE, {}), 2, "order 2 does not cross C1", 0.4),
    ):
        f_omega, amplitude, why = peaks.peak(coating, order, settings)
        assert np.isnan([f_omega, amplitude]).all()
        assert why.startswith(reason)
        assert coating.f_omega[peaks.nearest_speed(coating, order, settings)] == nearest
