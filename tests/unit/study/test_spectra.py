import numpy as np
import pytest
from scipy import ndimage, signal

from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import dominant_harmonic, lobes

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
