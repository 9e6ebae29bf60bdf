"""Inner shape of the distorted casing and the gap it leaves (Fig. 5)."""

from functools import lru_cache

import numpy as np
import scipy  # its parts when they are used: every call of snakemake imports this module

from bladerub.contact.spec import Casing

_TURN = 2 * np.pi


def shape(casing: Casing, angle: np.ndarray) -> np.ndarray:
    """Inward displacement at `angle` (rad) over the amplitude.

    It is ``Σ w_n f_n(φ)`` divided by its maximum, where ``f_n`` is ``cos(n φ)``. With a `bump_width` w it is
    ``exp(−(d / (w L))²)``, d being the angle to the nearest of n even bumps, the first at 0, and L = 2π/n:
    for two bumps eqs. (3) and (4) of Piollet, Nyssen and Batailly (J. Sound Vib. 460, 2019, 114878). A
    measured shape passes through its points without overshoot (Fritsch and Carlson 1980).
    """
    if casing.measured:
        return _through(casing.measured)(np.asarray(angle) % _TURN)
    return _sum_of_terms(casing, np.asarray(angle)) / _largest_sum(casing)


def gap(casing: Casing, clearance: float | np.ndarray, angle: np.ndarray) -> np.ndarray:
    """Gap g₀ of eq. (8) at `angle` (rad), ``c_j + (a − δ) − a s(φ)``, m.

    It is negative where tip and coating overlap. `clearance` is that of the node, c_j (m), and is broadcast.
    """
    offset = casing.amplitude - casing.interference
    return clearance + offset - casing.amplitude * shape(casing, angle)


def _sum_of_terms(casing: Casing, angle: np.ndarray) -> np.ndarray:
    phase = np.multiply.outer(angle, casing.nodal_diameters)
    if not casing.bump_width:
        return np.cos(phase) @ np.asarray(casing.weights)
    distance = phase / _TURN  # from a bump, over that between two
    distance -= np.round(distance)
    return np.exp(-((distance / casing.bump_width) ** 2)) @ np.asarray(casing.weights)


@lru_cache
def _largest_sum(casing: Casing) -> float:
    return float(np.max(_sum_of_terms(casing, np.linspace(0, _TURN, 72_001))))


@lru_cache
def _through(points: tuple[tuple[float, float], ...]) -> "scipy.interpolate.PchipInterpolator":
    angle, inward = np.array(points).T
    turns = np.concatenate([angle + turn for turn in (-_TURN, 0.0, _TURN)])
    return scipy.interpolate.PchipInterpolator(turns, np.tile(inward, 3))
