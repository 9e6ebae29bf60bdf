import numpy as np
import pytest
from scipy import ndimage, signal

from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import dominant_harmonic, lobes

SAMPLES = 400


def sine(order, revolutions=20, amplitude=1.0, phase=0.3):
    time = (np.arange(revolutions * SAMPLES) + 0.5) / SAMPLES
    return amplitude * np.sin(2 * np.pi * order * time + phase)


def spectrum(u, revolutions=20, spectrum_revolutions=10, max_order=24.0):
    return order_spectrum(u, revolutions, spectrum_revolutions, max_order)


@pytest.mark.parametrize("order", [1, 4, 6, 6.1, 23.9])
def test_a_sine_on_a_bin_reads_its_amplitude(order):
    orders, amplitude = spectrum(sine(order, amplitude=2e-3))
    assert orders[np.argmax(amplitude)] == pytest.approx(order)
    assert amplitude.max() == pytest.approx(2e-3, rel=1e-9)
    assert amplitude[np.abs(orders - order) > 0.15].max() < 1e-12  # the Hann window leaks to one neighbour


def test_a_sine_half_way_between_bins_reads_the_scalloping_of_the_window():
    _, amplitude = spectrum(sine(6.05))
    assert amplitude.max() == pytest.approx(8 / (3 * np.pi), rel=1e-3)  # Harris 1978, Hann: 1.42 dB


def test_two_sines_and_the_mean_do_not_mix():
    _, alone = spectrum(sine(6))
    _, together = spectrum(sine(6) + sine(4, amplitude=0.5, phase=1.0) + 7.0)
    assert together[60] == pytest.approx(alone[60], rel=1e-9)
    assert together[40] == pytest.approx(0.5, rel=1e-9)
    assert together[0] == pytest.approx(0.0, abs=1e-12)


def test_only_the_last_revolutions_count():
    early = sine(4, amplitude=50.0)
    early[10 * SAMPLES :] = 0
    _, amplitude = spectrum(early + sine(6))
    assert amplitude[40] < 1e-9
    assert amplitude[60] == pytest.approx(1.0)


def test_a_run_that_ended_early_is_analysed_up_to_its_last_complete_revolution():
    u = sine(6)
    u[int(13.4 * SAMPLES) :] = np.nan
    u[13 * SAMPLES : int(13.4 * SAMPLES)] = 1e6  # the blow-up in the last, incomplete revolution
    order, amplitude = spectrum(u)
    assert order[np.argmax(amplitude)] == 6
    assert amplitude.max() == pytest.approx(1.0)


def test_a_short_run_keeps_bins_and_amplitude_at_less_resolution():
    u = sine(6)
    u[3 * SAMPLES + 5 :] = np.nan
    order, amplitude = spectrum(u)
    assert order.size == 241
    assert amplitude[60] == pytest.approx(1.0, rel=1e-2)
    assert amplitude[50] < 1e-9  # two bins of three revolutions away


PROMINENCE = 0.2


def pattern(angle, n, unequal=0.0, phase=0.0):
    """`n` separate lobes, the depth of which varies around the casing by `unequal`."""
    depth = 1 + unequal * np.cos(angle - 0.7)
    return 1e-3 * depth * np.clip(np.cos(n * angle + phase) - 0.2, 0, None)


@pytest.mark.parametrize(("n", "unequal"), [(1, 0.0), (5, 0.5), (20, 0.0)])
@pytest.mark.parametrize("phase", [0.0, np.pi])  # a lobe, a valley at the wrap-around
def test_lobes_of_a_synthetic_pattern_are_counted(angle, n, unequal, phase):
    assert lobes(angle, pattern(angle, n, unequal, phase), PROMINENCE) == n


def test_the_count_does_not_change_when_the_casing_is_turned(angle):
    rng = np.random.default_rng(3)
    wear = pattern(angle, 5, 0.6) + 2e-4 * rng.random(angle.size) * (pattern(angle, 5) > 0)
    counts = {lobes(angle, np.roll(wear, shift), PROMINENCE) for shift in range(0, angle.size, 7)}
    assert counts == {5}


def test_single_hits_within_a_lobe_are_no_lobes(angle):
    hits = pattern(angle, 6) * (np.arange(angle.size) % 12 < 6)  # a comb of 2.2 degrees
    assert lobes(angle, hits, PROMINENCE) == 6


def test_lobes_that_the_mean_of_the_nodes_levels_do_not_count(angle):
    wave = 1e-3 * np.cos(5 * angle)
    assert lobes(angle, np.stack([1e-3 + wave, 1e-3 - wave]), PROMINENCE) == 0


def test_shallow_lobes_do_not_count(angle):
    wear = pattern(angle, 2)
    wear += 0.1 * wear.max() * (np.abs(angle - np.pi / 2) < 0.1)
    assert lobes(angle, wear, PROMINENCE) == 2
    assert lobes(angle, wear, 0.05) == 3


def test_no_wear_and_an_even_ring_have_no_lobes(angle):
    assert lobes(angle, np.zeros((8, angle.size)), PROMINENCE) == 0
    assert lobes(angle, np.full(angle.size, 1e-3), PROMINENCE) == 0
    assert lobes(angle, 1e-3 * (1 + 0.05 * np.cos(7 * angle)), PROMINENCE) == 0


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


class TestDominantHarmonic:
    @pytest.mark.parametrize("count", [1, 10, 1000])
    def test_one_harmonic_has_all_of_the_variance(self, count):
        angle = 2 * np.pi * (np.arange(2000) + 0.5) / 2000
        wave = np.sin(count * angle + 0.3)
        assert dominant_harmonic(1e-3 * (1.5 + wave)) == (count, pytest.approx(1.0))

    def test_the_share_is_that_of_the_variance_of_the_mean_over_the_nodes(self, angle):
        wear = 1e-3 * (3 + 2 * np.cos(4 * angle) + np.cos(6 * angle))
        nodes = np.stack([wear, wear]) + 1e-3 * np.array([[1], [-1]]) * np.cos(9 * angle)
        assert dominant_harmonic(nodes) == (4, pytest.approx(4 / 5))

    @pytest.mark.parametrize("depth", [0.0, 1e-3])
    def test_no_wear_and_an_even_ring_have_none(self, angle, depth):
        assert dominant_harmonic(np.full((8, angle.size), depth)) == (0, 0.0)
