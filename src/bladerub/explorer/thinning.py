"""What of the maps goes into the page: fewer angles, and the part of the spectra that the figures show."""

from __future__ import annotations

import numpy as np

from bladerub.plots.spectrum import ORDERS

MOST_ANGLES = 500
"""Wear is averaged to at most so many stretches of the circumference."""
LAST_ORDER = ORDERS[-1] + 1
"""Spectra are kept up to this engine order at least, the end of the axis of orders."""


def stretches(n_elements: int) -> np.ndarray:
    """First element of each stretch of the circumference, and the end: (m + 1,) ndarray of int."""
    m = min(n_elements, MOST_ANGLES)
    return np.arange(m + 1) * n_elements // m


def stretch_means(values: np.ndarray, bounds: np.ndarray) -> np.ndarray:
    """Average `values` (n, n_elements) over the stretches between `bounds` (m + 1,), giving (n, m)."""
    return np.add.reduceat(values, bounds[:-1], axis=1, dtype=float) / np.diff(bounds)


def kept_orders(f_omega: np.ndarray, order: np.ndarray, max_frequency: float) -> np.ndarray:
    """How many of the ascending engine orders are kept at each speed: (n,) ndarray of int.

    All up to the frequency at which the figures end, and up to `LAST_ORDER`.

    Parameters
    ----------
    f_omega : (n,) ndarray
        Speeds, normalised.
    order : (m,) ndarray
        Engine orders of the spectra, from 0.
    max_frequency : float
        Normalised.
    """
    step = order[1] - order[0]
    last = np.maximum(LAST_ORDER, max_frequency / f_omega) + step  # the cell around the end is drawn
    return np.searchsorted(order, last, side="right")
