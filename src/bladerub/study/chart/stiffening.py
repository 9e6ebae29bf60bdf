"""Contact stiffening: which modulus the speed of a peak, f_k, follows (Fig. 12)."""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression
from scipy.stats import spearmanr

MODULI = ("E_T", "K", "E")
"""What f_k is set against: the modulus while wearing, the plastic modulus, Young's modulus."""


def is_stiffened(peaks: pd.DataFrame) -> pd.Series:
    """Tell which peaks are the resonance of their order.

    Contact can but raise the first frequency, and with it the crossing. Where the resonance does not stand
    out, the greatest amplitude of the window is that of another response, which may lie below.
    """
    return peaks.f_peak >= peaks.f_crossing


def table(peaks: pd.DataFrame) -> pd.DataFrame:
    """Sum up how closely f_k follows each of `MODULI`.

    Parameters
    ----------
    peaks : DataFrame
        Rows of ``chart_explanation.csv``.

    Returns
    -------
    DataFrame
        A row per order and θ: ``coatings``, those of `is_stiffened`, which the other columns are of;
        ``below_crossing``, how many are not; for each of `MODULI` the rank correlation
        ``rank_correlation_<modulus>``, and ``scatter_<modulus>``, the root mean square distance of f_k from
        the nearest curve that nowhere falls as the modulus rises.
    """
    rows = []
    for (order, theta), every in peaks.groupby(["order", "theta"]):
        cells = every[is_stiffened(every)]
        rows.append(
            {
                "order": order,
                "theta": theta,
                "coatings": len(cells),
                "below_crossing": len(every) - len(cells),
                **{f"rank_correlation_{modulus}": _rank_correlation(cells, modulus) for modulus in MODULI},
                **{f"scatter_{modulus}": _scatter(cells, modulus) for modulus in MODULI},
            }
        )
    return pd.DataFrame(rows)


def _rank_correlation(cells: pd.DataFrame, modulus: str) -> float:
    if min(cells[modulus].nunique(), cells.f_peak.nunique()) < 2:
        return np.nan  # of constants there is none
    return float(spearmanr(cells[modulus], cells.f_peak).statistic)


def _scatter(cells: pd.DataFrame, modulus: str) -> float:
    if cells.empty:
        return np.nan
    same = cells.groupby(modulus).f_peak  # one value of the curve for each modulus
    curve = pd.Series(isotonic_regression(same.mean(), weights=same.size()).x, index=same.mean().index)
    return float(np.sqrt(np.mean((cells.f_peak - cells[modulus].map(curve)) ** 2)))
