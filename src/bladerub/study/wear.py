"""Worn patterns: how many lobes the blade has cut around the casing, and which harmonic is strongest."""

import numpy as np
import scipy

SMOOTHING_ANGLE = np.radians(6.0)
"""Width of the Hann window that smooths a pattern, rad: the single hits within a lobe are closer than that
and twenty lobes further apart."""


def lobes(angle: np.ndarray, wear: np.ndarray, prominence: float) -> int:
    """Count the worn lobes around the circumference; their number does not change when the casing is turned.

    The worn depth `wear`, (j, n) or (n,), m, is averaged over the nodes and smoothed around the circle over
    `SMOOTHING_ANGLE`; `angle` (n,), rad, is even around it. A lobe is a maximum above the valleys on both
    sides by at least `prominence` of the greatest smoothed depth. Even wear all around has none.
    """
    width = max(1, round(SMOOTHING_ANGLE / (2 * np.pi / angle.size)))
    kernel = np.hanning(width + 2)[1:-1]  # without its two zeros
    mean = np.atleast_2d(wear).mean(axis=0)
    depth = scipy.ndimage.convolve1d(mean, kernel / kernel.sum(), mode="wrap")
    if depth.max() <= 0:
        return 0
    # cut the circle at its lowest point, so that no lobe is split and every valley is seen from both sides
    opened = np.roll(depth, -int(np.argmin(depth)))
    return _count_peaks(opened, prominence * depth.max())


def dominant_harmonic(wear: np.ndarray) -> tuple[int, float]:
    """Find the harmonic of the casing angle that is strongest in the worn depth: `lobes` without a threshold.

    `wear` is (j, n) or (n,) at even angles, m. Returns the harmonic, 1 or more, and its share of the variance
    of the mean over the nodes; (0, 0.0) where the casing is not worn, or evenly.
    """
    depth = np.atleast_2d(wear).mean(axis=0)
    power = np.abs(np.fft.rfft(depth)[1:]) ** 2
    if depth.size % 2 == 0:
        power[-1] /= 2  # at the highest harmonic cosine and sine are one line of the spectrum, not two
    if power.sum() <= 1e-24 * np.sum(depth**2) * depth.size:
        return 0, 0.0
    strongest = int(power.argmax())
    return strongest + 1, float(power[strongest] / power.sum())


def _count_peaks(curve: np.ndarray, prominence: float) -> int:
    """Count the maxima of a curve that begins and ends at its lowest point, by prominence.

    They are as many as there are ascents by `prominence`, each followed by a descent by as much. (The
    library's peaks take a job longer to import than everything else that it does.)
    """
    changing = curve[np.append(True, np.diff(curve) != 0)]
    steps = np.diff(changing, append=curve[0])
    turns = changing[steps * np.roll(steps, 1) <= 0]
    count, high, extreme = 0, False, curve[0]  # on high ground the extreme is the top, else the bottom
    for value in [*turns, curve[0]]:
        extreme = max(extreme, value) if high else min(extreme, value)
        if abs(value - extreme) >= prominence:
            count += high
            high, extreme = not high, value
    return count
