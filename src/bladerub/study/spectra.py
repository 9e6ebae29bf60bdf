"""Spectra of the blade's response over engine orders."""

import numpy as np
import scipy


def order_spectrum(
    radial_displacement: np.ndarray, revolutions: int, spectrum_revolutions: int, max_order: float
) -> tuple[np.ndarray, np.ndarray]:
    """Find the amplitude spectrum over engine order of the last revolutions of a run.

    `radial_displacement` (revolutions n,), m, is that at n equal steps of angle in each of the `revolutions`,
    NaN after an early end. Returns the engine orders (m,) from 0 to `max_order`, n / 2 at most, in steps of
    ``1 / spectrum_revolutions``, and the amplitude (m,) at each, m.

    A Hann window over a whole number of revolutions puts every engine order on a bin. The mean is removed
    and the window's gain corrected, so that a sine of amplitude A on a bin reads A; midway between two
    bins it reads 0.85 A.

    A run that ended early is analysed over its last complete revolutions, `spectrum_revolutions` of them at
    most. When there are fewer, they are padded with zeros: the same bins, at less resolution. A run that did
    not complete one revolution has NaN amplitudes.
    """
    samples = radial_displacement.size // revolutions
    n_bins = int(np.floor(max_order * spectrum_revolutions + 1e-9)) + 1
    order = np.arange(n_bins) / spectrum_revolutions

    missing = np.isnan(radial_displacement)
    complete = (int(np.argmax(missing)) if missing.any() else missing.size) // samples
    used = min(spectrum_revolutions, complete)
    if used == 0:
        return order, np.full(n_bins, np.nan)
    record = radial_displacement[(complete - used) * samples : complete * samples]
    window = np.hanning(record.size + 1)[:-1]  # periodic; scipy.signal takes half a second to import
    transform = scipy.fft.rfft((record - record.mean()) * window, n=spectrum_revolutions * samples)[:n_bins]
    amplitude = 2 * np.abs(transform) / window.sum()
    amplitude[0] /= 2  # order 0 has no mirror image at negative orders
    return order, amplitude
