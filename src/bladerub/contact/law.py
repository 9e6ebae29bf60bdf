"""Bar element of the abradable layer: one-dimensional plasticity with linear hardening (Fig. 4)."""

from __future__ import annotations

import numpy as np
from numba import njit

from bladerub.contact.spec import Coating


@njit(inline="always")
def return_mapping(penetration, wear, elastic, hardening, strength):
    """Force and new wear of one bar compressed by `penetration`.

    The law is homogeneous: with (N/m, N/m, N) it gives a force, with (1/m, 1/m, 1) a stress.

    Parameters
    ----------
    penetration : float
        Depth of the tip below the original surface, m.
    wear : float
        Permanent shortening of the bar so far, m.
    elastic, hardening : float
        Slopes that belong to E and to K.
    strength : float
        Elastic limit of the unworn bar.

    Returns
    -------
    force, wear : float
        Force of the bar, 0 where the tip does not reach the worn surface, and the wear after it.

    Notes
    -----
    Bars push and never pull, so the accumulated plastic strain is wear over thickness and the
    plastic multiplier is ``Δγ = f / (E + K)``; loading follows ``E_T = E K / (E + K)``.
    """
    trial = elastic * (penetration - wear)
    if trial <= 0.0:
        return 0.0, wear
    excess = trial - strength - hardening * wear
    if excess <= 0.0:
        return trial, wear
    shortening = excess / (elastic + hardening)
    return trial - elastic * shortening, wear + shortening


@njit
def _load(penetration, wear, elastic, hardening, strength, stress, new_wear):
    for i in range(penetration.size):
        stress[i], new_wear[i] = return_mapping(penetration[i], wear[i], elastic, hardening, strength)


def load(coating: Coating, penetration: np.ndarray, wear: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compress bars of the coating to `penetration`.

    Parameters
    ----------
    coating : Coating
        Moduli, elastic limit and thickness.
    penetration, wear : array_like
        Depth of the tip below the original surface and permanent shortening, m; broadcast together.

    Returns
    -------
    stress : ndarray
        Compressive stress, normalised by the coating's modulus unit.
    wear : ndarray
        Permanent shortening after it, m.
    """
    penetration, wear = np.broadcast_arrays(np.asarray(penetration, float), np.asarray(wear, float))
    stress, new_wear = np.empty(penetration.size), np.empty(penetration.size)
    per_metre = 1.0 / coating.thickness
    _load(
        penetration.ravel(),
        wear.ravel(),
        coating.E * per_metre,
        coating.K * per_metre,
        coating.yield_stress,
        stress,
        new_wear,
    )
    return stress.reshape(penetration.shape), new_wear.reshape(penetration.shape)
