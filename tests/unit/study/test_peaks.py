import numpy as np
import pytest

from bladerub.study import divergence, peaks
from bladerub.study.grid import CoatingCase
from bladerub.study.peaks import table
from bladerub.study.store import stored_run
from bladerub.study.summary import spectral_peak, summarise

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)


@pytest.fixture
def settings(config):
    return config.analysis.peaks.model_copy(update={"order_halfwidth": 0.25, "speed_window": [0.85, 1.25]})


@pytest.mark.parametrize("order", [4, 6])
def test_the_crossing_is_where_the_engine_order_meets_c1(make_map, order):
    fine = make_map(CASE, {}, np.linspace(0.02, 0.4, 400))
    exact = 1 / np.sqrt(order**2 - 3)  # of C1² = 1 + 3 f²
    assert peaks.crossing_speed(fine, order) == pytest.approx(exact, abs=1e-6)


def test_the_peak_is_the_largest_amplitude_on_the_order_near_the_crossing(make_map, settings):
    crossing = 1 / np.sqrt(33)  # order 6
    coating = make_map(CASE, {4: (0.3, 2e-4), 6: (0.2, 1e-4), 6.5: (0.2, 9e-4), 5.7: (0.19, 9e-4)})
    outside = (coating.f_omega > 1.25 * crossing) | (coating.f_omega < 0.85 * crossing)
    coating.spectrum_amplitude[outside, 60] = 9e-4
    assert peaks.peak(coating, 4, settings) == peaks.Peak(0.3, pytest.approx(2e-4))
    assert peaks.peak(coating, 6, settings) == peaks.Peak(0.2, pytest.approx(1e-4))
    coating.spectrum_amplitude[np.isclose(coating.f_omega, 0.2)] = np.nan  # a run without a spectrum
    assert peaks.peak(coating, 6, settings).f_omega in (0.19, 0.21)


@pytest.mark.parametrize(("halfwidth", "counts"), [(0.19, False), (0.2, True), (0.21, True)])
@pytest.mark.parametrize("side", [-1, 1])
def test_a_line_at_the_halfwidth_belongs_to_the_order(make_map, halfwidth, counts, side):
    coating = make_map(CASE, {6: (0.2, 1e-4), 6 + 0.2 * side: (0.2, 9e-4)})
    found = peaks.order_amplitude(coating, 6, halfwidth)[coating.f_omega == 0.2]
    assert found == pytest.approx(9e-4 if counts else 1e-4)


def test_a_missing_peak_has_a_reason(make_map, settings):
    unbounded = make_map(CASE, {})
    unbounded.spectrum_amplitude[(unbounded.f_omega > 0.1) & (unbounded.f_omega < 0.25)] = np.nan
    for coating, order, reason in (
        (make_map(CASE, {}, [0.05, 0.1, 0.3]), 6, "no run between"),
        (unbounded, 6, "none of the 7 runs between"),
        (make_map(CASE, {}), 2, "order 2 does not cross C1"),
    ):
        f_omega, amplitude, why = peaks.peak(coating, order, settings)
        assert np.isnan([f_omega, amplitude]).all()
        assert why.startswith(reason)
    with pytest.raises(ValueError, match=r"max_order: the spectra of 2nd_E1.1_\S+ do not reach order 25"):
        peaks.peak(make_map(CASE, {}), 25, settings)


def test_the_table_has_a_row_per_coating_and_order(config, make_map):
    maps = [
        make_map(CoatingCase("2nd", E, 0.5, 0.0), {4: (0.31, E * 1e-4), 6: (f_peak, E * 2e-4)})
        for E, f_peak in ((0.11, 0.19), (1.1, 0.21))
    ]
    found = table(config, maps)
    assert list(found.columns) == peaks.COLUMNS
    expected = [(0.11, 4, 0.31), (0.11, 6, 0.19), (1.1, 4, 0.31), (1.1, 6, 0.21)]
    assert list(found[["E", "order", "f_peak"]].itertuples(index=False, name=None)) == expected
    np.testing.assert_allclose(found.amplitude, [1.1e-5, 2.2e-5, 1.1e-4, 2.2e-4])


def test_the_table_has_a_row_per_run_judged_by_the_longer_one_where_there_is_one(config, make_map, case):
    longer = np.full((4, 60), np.nan)
    longer[0] = 1.03 ** np.arange(60)
    longer[1] = 1 - np.exp(-np.arange(1, 61) / 12)
    longer[2, :41] = 1.03 ** np.arange(41)
    speeds, lobes = [0.1, 0.2, 0.3, 0.4], [5, 6, 4, 3]
    maps = [
        make_map(CASE, {}, speeds, lobes, [0, 0, 0.05, 0.002], ["completed"] * 3 + ["unbounded"]),
        make_map(case, {}, speeds, lobes, [0.03, 0.03, 0.03, 0.0], longer=longer),
    ]
    maps[0].revolution_amplitude[3, 19:] = np.nan  # it ended in the 20th
    table = divergence.table(config, maps)
    assert list(table.columns) == divergence.COLUMNS
    assert list(table.E) == [1.1] * 4 + [2.0] * 4
    assert list(table.f_omega) == speeds * 2
    assert list(table.lobes) == lobes * 2
    assert list(table.divergent) == [False, False, True, True, True, False, True, False]
    words = [divergence.in_a_word(verdict) for verdict in divergence.verdicts(config, maps[1])]
    assert words == ["divergent", "saturating", "divergent", "bounded"]
    assert list(table.saturating) == [False] * 5 + [True, False, False]
    assert list(table.revolutions) == [20] * 4 + [60, 60, 42, 20]
    assert np.flatnonzero(table.status == "unbounded").tolist() == [3, 6]
    np.testing.assert_allclose(table.growth_per_revolution, [0, 0, 0.05, 0.002, 0.03, 0, 0.03, 0], atol=2e-3)
    assert (table.growth_low < table.growth_per_revolution).all()
    assert (table.growth_high > table.growth_per_revolution).all()


def test_a_steady_and_a_growing_run(spec, config, make_result):
    def summed_up(result):
        return summarise(stored_run(CASE, spec, result, "key", config.analysis, False), config.analysis)

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
    summary = summed_up(make_result(order=4, growth=0.03))
    assert (summary["divergent"], summary["saturating"]) == (True, False)
    assert summary["peak_amplitude"] == pytest.approx(1e-3 * 1.03**19, rel=1e-4)


@pytest.mark.parametrize(("order", "found"), [(0.4, 6.0), (0.5, 0.5)])
def test_slow_drift_is_no_vibration(order, found):
    orders = np.arange(100) / 10
    amplitude = np.where(orders == order, 2.0, np.where(orders == 6.0, 1.0, 0.0))
    assert spectral_peak(orders, amplitude) == (found, 1.0 if order < 0.5 else 2.0)
