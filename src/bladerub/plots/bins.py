"""Bins of colour maps: where each simulated speed reaches to, and where nothing was simulated."""

import numpy as np


def edges(centres: np.ndarray) -> np.ndarray:
    """Edges (n + 1,) of the bins around `centres` (n,), half-way between; `ValueError` unless they ascend."""
    centres = np.asarray(centres, dtype=float)
    if centres.size < 2 or np.any(np.diff(centres) <= 0):
        raise ValueError(f"bins need two or more ascending centres, not {centres}")
    middle = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])


def with_gaps(f_omega: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bins around the simulated speeds (n,), with an empty row wherever speeds are missing.

    A bin reaches to the middle between neighbours, but no further than the usual speed step: a long stretch
    without a simulation stays a gap. Returns the edges of the m ≥ n bins, and the rows of `values` (n, ...)
    with rows of NaN in the gaps.
    """
    f_omega, values = np.asarray(f_omega, dtype=float), np.asarray(values, dtype=float)
    middle = edges(f_omega)
    reach = np.median(np.diff(f_omega))
    lower, upper = np.maximum(middle[:-1], f_omega - reach), np.minimum(middle[1:], f_omega + reach)
    gaps = np.flatnonzero(lower[1:] > upper[:-1]) + 1
    return np.union1d(lower, upper), np.insert(values, gaps, np.nan, axis=0)
