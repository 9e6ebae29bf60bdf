import numpy as np
import pytest
from scipy import ndimage, signal

from bladerub.study import divergence, peaks
from bladerub.study.grid import CoatingCase
from bladerub.study.peaks import table
from bladerub.study.spectra import order_spectrum
from bladerub.study.store import stored_run
from bladerub.study.summary import spectral_peak, summarise
from bladerub.study.wear import dominant_harmonic, lobes

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

    found = summed_up(make_result(order=6, amplitude=1e-3, depth=2e-4))
    expected = {"peak_amplitude": 1e-3, "max_wear": 2e-4, "energy_residual": 1.23}  # the last of the stand-in
    expected |= {"engine_order": 6.0, "lobes": 6, "wear_harmonic": 6, "wear_harmonic_share": 0.84}
    expected |= {"growth_revolutions": 20, "n_steps": 1000}
    assert {name: found[name] for name in expected} == pytest.approx(expected, rel=0.01)
    growth = [found[f"growth_{of}"] for of in ("per_revolution", "low", "high")]
    assert growth == pytest.approx([0, -3e-4, 3e-4], abs=6e-5)
    assert (found["saturating"], found["divergent"], found["status"]) == (False, False, "completed")
    summary = summed_up(make_result(order=4, growth=0.03))
    assert (summary["divergent"], summary["saturating"]) == (True, False)
    assert summary["peak_amplitude"] == pytest.approx(1e-3 * 1.03**19, rel=1e-4)


@pytest.mark.parametrize(("order", "found"), [(0.4, 6.0), (0.5, 0.5)])
def test_slow_drift_is_no_vibration(order, found):
    orders = np.arange(100) / 10
    amplitude = np.where(orders == order, 2.0, np.where(orders == 6.0, 1.0, 0.0))
    assert spectral_peak(orders, amplitude) == (found, 1.0 if order < 0.5 else 2.0)


SAMPLES = 400
PROMINENCE = 0.2


def sine(order, revolutions=20, amplitude=1.0, phase=0.3):
    time = (np.arange(revolutions * SAMPLES) + 0.5) / SAMPLES
    return amplitude * np.sin(2 * np.pi * order * time + phase)


def spectrum(u):
    return order_spectrum(u, 20, 10, 24.0)


@pytest.mark.parametrize("order", [4, 6.1, 23.9])
def test_a_sine_reads_its_amplitude_and_half_way_between_bins_the_scalloping_of_the_window(order):
    orders, amplitude = spectrum(sine(order, amplitude=2e-3))
    assert orders[np.argmax(amplitude)] == pytest.approx(order)
    assert amplitude.max() == pytest.approx(2e-3, rel=1e-9)
    assert amplitude[np.abs(orders - order) > 0.15].max() < 1e-12  # the Hann window leaks to one neighbour
    _, between = spectrum(sine(order - 0.05))
    assert between.max() == pytest.approx(8 / (3 * np.pi), rel=1e-3)  # Harris 1978, Hann: 1.42 dB


def test_two_sines_and_the_mean_of_the_last_complete_revolutions_do_not_mix():
    u = sine(6) + sine(4, amplitude=0.5, phase=1.0) + 7.0
    u[: 3 * SAMPLES] += sine(3, 3, amplitude=50.0)
    u[13 * SAMPLES : int(13.4 * SAMPLES)] = 1e6  # the blow-up in the last, incomplete revolution
    u[int(13.4 * SAMPLES) :] = np.nan
    _, amplitude = spectrum(u)
    np.testing.assert_allclose(amplitude[[60, 40]], [1.0, 0.5], rtol=1e-9)
    assert amplitude[[0, 30]].max() < 1e-11


def test_a_short_run_keeps_bins_and_amplitude_at_less_resolution():
    u = sine(6)
    u[3 * SAMPLES + 5 :] = np.nan
    order, amplitude = spectrum(u)
    assert order.size == 241
    assert amplitude[60] == pytest.approx(1.0, rel=1e-2)
    assert amplitude[50] < 1e-9  # two bins of three revolutions away


def pattern(angle, n, unequal=0.0, phase=0.0):
    """`n` separate lobes, the depth of which varies around the casing by `unequal`."""
    depth = 1 + unequal * np.cos(angle - 0.7)
    return 1e-3 * depth * np.clip(np.cos(n * angle + phase) - 0.2, 0, None)


@pytest.mark.parametrize(("n", "unequal"), [(1, 0.0), (5, 0.5), (20, 0.0)])
@pytest.mark.parametrize("phase", [0.0, np.pi])  # a lobe, a valley at the wrap-around
def test_lobes_are_counted_and_not_the_single_hits_within_them(angle, n, unequal, phase):
    wear = pattern(angle, n, unequal, phase)
    hits = wear * (np.arange(angle.size) % 12 < 6)  # a comb of 2.2 degrees
    assert lobes(angle, wear, PROMINENCE) == lobes(angle, hits, PROMINENCE) == n


def test_shallow_lobes_and_those_that_the_mean_of_the_nodes_levels_do_not_count(angle):
    wear = pattern(angle, 2)
    wear += 0.1 * wear.max() * (np.abs(angle - np.pi / 2) < 0.1)
    assert lobes(angle, wear, PROMINENCE) == 2
    assert lobes(angle, wear, 0.05) == 3
    wave = 1e-3 * np.cos(5 * angle)
    assert lobes(angle, np.stack([1e-3 + wave, 1e-3 - wave]), PROMINENCE) == 0
    assert lobes(angle, 1e-3 * (1 + 0.05 * np.cos(7 * angle)), PROMINENCE) == 0


def test_no_wear_and_an_even_ring_have_neither_lobes_nor_a_harmonic(angle):
    for even in (np.zeros((8, angle.size)), np.full((8, angle.size), 1e-3)):
        assert lobes(angle, even, PROMINENCE) == 0
        assert dominant_harmonic(even) == (0, 0.0)


@pytest.mark.parametrize("seed", range(3))
def test_a_rough_pattern_has_as_many_peaks_as_the_library_finds(angle, seed):
    rng = np.random.default_rng(seed)
    depth = ndimage.gaussian_filter1d(rng.random(angle.size), rng.uniform(5, 40), mode="wrap")
    wear = 1e-3 * (depth - depth.min())
    # as `lobes` smooths it, opened at the lowest point
    width = round(np.radians(6.0) / (angle[1] - angle[0]))
    window = np.hanning(width + 2)[1:-1]
    smooth = ndimage.convolve1d(wear, window / window.sum(), mode="wrap")
    opened = np.roll(smooth, -int(np.argmin(smooth)))
    for prominence in (0.02, 0.1, 0.3):
        expected, _ = signal.find_peaks(np.append(opened, opened[0]), prominence=prominence * smooth.max())
        assert lobes(angle, wear, prominence) == len(expected) > 0


def test_the_share_of_a_harmonic_is_that_of_the_variance_of_the_mean_over_the_nodes(angle):
    wear = 1e-3 * (3 + 2 * np.cos(4 * angle) + np.cos(6 * angle) + np.sin(1000 * angle))
    nodes = np.stack([wear, wear]) + 1e-3 * np.array([[1], [-1]]) * np.cos(9 * angle)
    assert dominant_harmonic(nodes) == (4, pytest.approx(4 / 7))
    for count in (1, 1000):
        assert dominant_harmonic(1e-3 * (1.5 + np.sin(count * angle + 0.3))) == (count, pytest.approx(1.0))
