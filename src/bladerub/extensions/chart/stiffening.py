"""Contact stiffening: which modulus the speed f_k of a peak follows (Fig. 12), and what θ does to it.

While it wears, a bar gives way with E_T = E K / (E + K). A small displacement of the first mode presses bar j
by u_r,j; its force E_T u_r,j, along the inclined bar, works on that mode as
``E_T u_r,j (u_r,j cos θ + u_t,j sin θ)``. Summed over the nodes, over the sum for straight bars, that is the
*share* of E_T that stiffens the mode. If nothing else mattered, inclined bars would need ``1 / share`` times
the modulus for the same f_k.
"""

from __future__ import annotations

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression
from scipy.stats import spearmanr

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import modes_at

MODULI = ("E_T", "K", "E")
"""What f_k is set against: the modulus while wearing, the plastic modulus, Young's modulus."""

SMALL = 0.05
"""Part of the crossing speed by which a small stiffening raises f_k at most."""


def is_stiffened(peaks: pd.DataFrame) -> pd.Series:
    """Tell which peaks are the resonance of their order.

    As long as its `share` is positive, contact can but raise the first frequency, and with it the crossing.
    Where the resonance does not stand out, the greatest amplitude of the window is that of another response,
    which may lie below.
    """
    return peaks.f_peak >= peaks.f_crossing


def share(blade: ReducedBlade, theta: float, f_omega: float) -> float:
    """Share of the bars' modulus that stiffens the first mode at the normalised speed `f_omega`."""
    radial, tangential = np.split(modes_at(blade, f_omega).tip[:, 0], 2)
    work = radial @ (radial * np.cos(theta) + tangential * np.sin(theta))
    return float(work / (radial @ radial))


def table(peaks: pd.DataFrame, blade: ReducedBlade) -> pd.DataFrame:
    """Sum up how closely f_k follows each of `MODULI`, and what θ changes.

    Parameters
    ----------
    peaks : DataFrame
        Rows of ``chart_explanation.csv``.
    blade : ReducedBlade
        The blade of the chart.

    Returns
    -------
    DataFrame
        A row per order and θ: ``coatings``, those of `is_stiffened`, which the other columns are of;
        ``below_crossing``, how many are not; for each of `MODULI` the rank correlation
        ``rank_correlation_<modulus>``, and ``scatter_<modulus>``, the root mean square distance of f_k from
        the nearest curve that nowhere falls as the modulus rises; ``modulus_ratio``, E_T over that of the
        first θ at the same f_k (medians at each f_k that both have, the median of these ratios) where
        stiffening is `SMALL`, and ``modulus_ratio_by_share``, what `share` lets expect.
    """
    rows = []
    for order, of_order in peaks.groupby("order"):
        crossing, kept = float(of_order.f_crossing.mean()), of_order[is_stiffened(of_order)]
        first = of_order.theta.min()
        first_share = share(blade, first, crossing)
        for theta, every in of_order.groupby("theta"):
            cells = kept[kept.theta == theta]
            rows.append(
                {
                    "order": order,
                    "theta": theta,
                    "coatings": len(cells),
                    "below_crossing": len(every) - len(cells),
                    **{f"rank_correlation_{name}": _rank_correlation(cells, name) for name in MODULI},
                    **{f"scatter_{name}": _scatter(cells, name) for name in MODULI},
                    "modulus_ratio": _modulus_ratio(cells, kept[kept.theta == first]),
                    "modulus_ratio_by_share": first_share / share(blade, theta, crossing),
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


def _modulus_ratio(cells: pd.DataFrame, first: pd.DataFrame) -> float:
    moduli = [
        rows[rows.f_peak <= (1 + SMALL) * rows.f_crossing].groupby("f_peak").E_T.median()
        for rows in (cells, first)
    ]
    return float((moduli[0] / moduli[1]).median())  # of speeds that both have; aligned by speed
