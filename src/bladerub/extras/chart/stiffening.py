"""What goes with a peak: worn lobes, energy in a cycle, and the modulus of the contact that f_k follows.

Contact stiffens the blade (Fig. 12). While it wears, an element of the coating has the tangent modulus
E_T = E K / (E + K). A small displacement of the first mode compresses element j by u_r,j; its force
E_T u_r,j, along the inclined element, does the work ``E_T u_r,j (u_r,j cos θ + u_t,j sin θ)`` on that mode.
Summed over the nodes, over the sum for straight elements, that is the *share* of E_T that stiffens the mode.
If nothing else mattered, inclined elements would need ``1 / share`` times the modulus for the same f_k.
"""

import itertools
from collections.abc import Iterable

import numpy as np
import pandas as pd
from scipy.optimize import isotonic_regression
from scipy.stats import spearmanr

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import modes_at
from bladerub.extras.chart.point import ChartPoint, chart_orders
from bladerub.extras.chart.table import COATING
from bladerub.settings.study import Config
from bladerub.study.peaks import crossing_speed, row

LOSSES = ("wear", "sliding", "damping")
"""Where the energy goes: wear of the coating, its tangential resistance, damping of the blade."""

EXPLANATION = [
    *(*COATING, "order", "E_T", "f_crossing", "f_peak", "amplitude", "lobes"),
    *(f"{loss}_per_cycle" for loss in LOSSES),
]
"""Columns of ``chart_explanation.csv``."""

MODULI = ("E_T", "K", "E")
"""Moduli that f_k may follow: that of the wearing coating, the plastic modulus, Young's modulus."""

SMALL = 0.05
"""Greatest rise of f_k, relative to the crossing speed, that counts as small stiffening."""


def contact_stiffness(E: float, K: float) -> float:
    """Tangent modulus of the coating while it wears, E_T = E K / (E + K): both moduli in series."""
    return E * K / (E + K)


def explanation(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Look at the run at the peak of each engine order.

    A row per point and order, with `EXPLANATION`. Energies are means over the run, in which a vibration on
    the order k has k cycles per revolution. Without a peak all but ``E_T`` and ``f_crossing`` is NaN.
    """
    rows = []
    for point, order in itertools.product(points, chart_orders(config)):
        about = row(point, order, config.analysis.peaks) | {
            "E_T": contact_stiffness(point.case.E, point.case.K),
            "f_crossing": crossing_speed(point, order),
        }
        rows.append(about)
        if about["reason"]:
            continue  # no peak to look at
        index = int(np.flatnonzero(point.f_omega == about["f_peak"])[0])
        cycles = order * point.measures["revolutions"][index]
        about["lobes"] = int(point.measures["lobes"][index])
        about |= {f"{loss}_per_cycle": point.measures[f"energy_{loss}"][index] / cycles for loss in LOSSES}
    return pd.DataFrame(rows, columns=EXPLANATION)


def is_stiffened(peaks: pd.DataFrame) -> pd.Series:
    """Select the peaks that are the resonance of their order.

    As long as its `share` is positive, contact raises the first frequency and with it the crossing. A peak
    below the crossing is that of another response, higher than the resonance.
    """
    return peaks.f_peak >= peaks.f_crossing


def share(blade: ReducedBlade, theta: float, f_omega: float) -> float:
    """Share of the elements' modulus that stiffens the first mode at the normalised speed `f_omega`."""
    radial, tangential = np.split(modes_at(blade, f_omega).tip[:, 0], 2)
    work = radial @ (radial * np.cos(theta) + tangential * np.sin(theta))
    return float(work / (radial @ radial))


def table(peaks: pd.DataFrame, blade: ReducedBlade) -> pd.DataFrame:
    """Sum up how closely f_k follows each of `MODULI`, and how θ changes it, from `peaks` of `explanation`.

    A row per order and θ; all columns but ``below_crossing`` are of the coatings in `is_stiffened`.
    ``modulus_ratio`` is the median of those at each f_k that both θ have where stiffening is `SMALL`,
    ``modulus_ratio_by_share`` is the ratio expected from `share`.
    """
    rows = []
    for order, of_order in peaks.groupby("order"):
        crossing, stiffened = float(of_order.f_crossing.mean()), of_order[is_stiffened(of_order)]
        first = of_order.theta.min()
        first_share = share(blade, first, crossing)
        for theta, every in of_order.groupby("theta"):
            points = stiffened[stiffened.theta == theta]
            rows.append(
                {
                    "order": order,
                    "theta": theta,
                    "coatings": len(points),
                    "below_crossing": len(every) - len(points),
                    **{f"rank_correlation_{name}": _rank_correlation(points, name) for name in MODULI},
                    **{f"scatter_{name}": _scatter(points, name) for name in MODULI},
                    "modulus_ratio": _modulus_ratio(points, stiffened[stiffened.theta == first]),
                    "modulus_ratio_by_share": first_share / share(blade, theta, crossing),
                }
            )
    return pd.DataFrame(rows)


def _rank_correlation(points: pd.DataFrame, modulus: str) -> float:
    if min(points[modulus].nunique(), points.f_peak.nunique()) < 2:
        return np.nan  # not defined for constants
    return float(spearmanr(points[modulus], points.f_peak).statistic)


def _scatter(points: pd.DataFrame, modulus: str) -> float:
    if points.empty:
        return np.nan
    groups = points.groupby(modulus).f_peak  # one value of the curve for each modulus
    curve = pd.Series(isotonic_regression(groups.mean(), weights=groups.size()).x, index=groups.mean().index)
    return float(np.sqrt(np.mean((points.f_peak - points[modulus].map(curve)) ** 2)))


def _modulus_ratio(points: pd.DataFrame, first: pd.DataFrame) -> float:
    moduli = [
        rows[rows.f_peak <= (1 + SMALL) * rows.f_crossing].groupby("f_peak").E_T.median()
        for rows in (points, first)
    ]
    return float((moduli[0] / moduli[1]).median())  # at speeds that both have: aligned by f_k
