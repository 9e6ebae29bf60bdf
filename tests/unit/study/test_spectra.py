import numpy as np
import pytest

from bladerub.study.spectra import order_spectrum

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
