"""What goes with a peak: worn lobes, energy in a cycle, and the modulus of the contact that f_k follows.

Contact stiffens the blade (Fig. 12). While it wears, an element of the coating has the tangent modulus
E_T = E K / (E + K). A small displacement of the first mode compresses element j by u_r,j; its force
E_T u_r,j, along the inclined element, does the work ``E_T u_r,j (u_r,j cos θ + u_t,j sin θ)`` on that mode.
Summed over the nodes, over the sum for straight elements, that is the *share* of E_T that stiffens the mode.
If nothing else mattered, inclined elements would need ``1 / share`` times the modulus for the same f_k.

The *ridge* of Y_k along E is, for each E, the K of the greatest Y_k; along K, for each K the E. A point has
eight or fewer neighbours. Both are determined again from the runs at even speeds of two and four times the
study's step: what the chart would show if it had no finer speeds.
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
from bladerub.study.peaks import amplitude_in_window, crossing_speed, maximum, row

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

MULTIPLES = (1, 2, 4)
"""Speed steps that are compared, in those of the study."""

_SURFACE = ["casing", "theta", "order"]
_HIGHEST = [*_SURFACE, "speed_step", "E", "K", "E_T", "f_peak", "amplitude"]
_UNCERTAIN = ["neighbour_spread", "height_lost", "K_shift"]

RIDGE = [*_SURFACE, "along", *_HIGHEST[3:], "lowest_neighbour", "highest_neighbour"]
"""Columns of ``chart_ridge.csv``."""
SUMMARY = [*_HIGHEST, "lowest_E_T", "highest_E_T", *_UNCERTAIN]
"""Columns of ``chart_ridge_summary.csv``."""


def contact_stiffness(E: float, K: float) -> float:
    """Tangent modulus of the coating while it wears, E_T = E K / (E + K): both moduli in series."""
    return E * K / (E + K)


def explanation(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Look at the run at the peak of each engine order: a row per point and order, with `EXPLANATION`."""
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
        cycles = order * point.measures["revolutions"][index]  # of a vibration on the order, over the run
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
    """Sum up for each order and θ how closely f_k follows each of `MODULI`, and how θ changes it."""
    rows = []
    for order, of_order in peaks.groupby("order"):
        crossing, stiffened = float(of_order.f_crossing.mean()), of_order[is_stiffened(of_order)]
        first = of_order.theta.min()
        for theta, every in of_order.groupby("theta"):
            points = stiffened[stiffened.theta == theta]
            ratio = share(blade, first, crossing) / share(blade, theta, crossing)
            rows.append(
                {"order": order, "theta": theta, "coatings": len(points)}
                | {"below_crossing": len(every) - len(points)}
                | {f"rank_correlation_{name}": _rank_correlation(points, name) for name in MODULI}
                | {f"scatter_{name}": _scatter(points, name) for name in MODULI}
                | {"modulus_ratio": _modulus_ratio(points, stiffened[stiffened.theta == first])}
                | {"modulus_ratio_by_share": ratio}
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


def ridges(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Find the ridges: a row with `RIDGE`, m, for each point on one; NaN for neighbours without a peak."""
    points, lines = list(points), []
    for multiple in MULTIPLES:
        peaks = _peaks(config, points, multiple).assign(speed_step=round(config.speeds.step * multiple, 9))
        lines += [_ridge(of_surface) for _, of_surface in peaks.groupby(_SURFACE)]
    return pd.concat(lines, ignore_index=True)[RIDGE]


def _peaks(config: Config, points: list[ChartPoint], multiple: int) -> pd.DataFrame:
    """Y_k of each point from its runs at speeds `multiple` steps of the study apart; NaN without any."""
    rows, settings = [], config.analysis.peaks
    for point, order in itertools.product(points, chart_orders(config)):
        first = point.f_omega[np.abs(point.f_omega - config.chart.speeds.start).argmin()]
        steps = (point.f_omega - first) / (config.speeds.step * multiple)
        even = (np.abs(steps - np.rint(steps)) < 1e-6) | (multiple == 1)
        peak = maximum(point, np.where(even, amplitude_in_window(point, order, settings), np.nan))
        case = point.case
        rows.append((case.casing, case.theta, order, case.E, case.K, peak.f_omega, peak.amplitude))
    return pd.DataFrame(rows, columns=[*_SURFACE, "E", "K", "f_peak", "amplitude"])


def _ridge(peaks: pd.DataFrame) -> pd.DataFrame:
    """Find both ridges of one surface, each in the order of its modulus; of equals the lowest modulus."""
    height = peaks.pivot(index="E", columns="K", values="amplitude")
    bordered = np.pad(height.to_numpy(), 1, constant_values=np.nan)
    peaks = peaks.dropna(subset="amplitude").sort_values(["E", "K"])
    ridge = pd.concat(
        peaks.loc[peaks.groupby(along).amplitude.idxmax()].assign(along=along) for along in ("E", "K")
    )
    places = zip(height.index.get_indexer(ridge.E), height.columns.get_indexer(ridge.K), strict=True)
    around = pd.DataFrame([np.delete(bordered[i : i + 3, j : j + 3], 4) for i, j in places])
    return ridge.assign(
        E_T=contact_stiffness(ridge.E, ridge.K),
        lowest_neighbour=around.min(axis=1).to_numpy(),
        highest_neighbour=around.max(axis=1).to_numpy(),
    )


def ridge_summary(ridges: pd.DataFrame) -> pd.DataFrame:
    """Sum up how certain the ridge along E is: its highest point, and medians over it, with `SUMMARY`."""
    along_E, line = ridges[ridges.along == "E"], [*_SURFACE, "speed_step"]
    finest = along_E[along_E.speed_step == along_E.speed_step.min()]
    along_E = along_E.merge(finest, "left", on=[*_SURFACE, "E"], suffixes=("", "_finest"))
    along_E["neighbour_spread"] = (along_E.highest_neighbour - along_E.lowest_neighbour) / along_E.amplitude
    along_E["height_lost"] = 1 - along_E.amplitude / along_E.amplitude_finest
    along_E["K_shift"] = np.abs(np.log(along_E.K / along_E.K_finest))
    lines = along_E.groupby(line)
    summed = lines[_UNCERTAIN].median()
    summed["K_shift"] = np.exp(summed["K_shift"])
    summed[["lowest_E_T", "highest_E_T"]] = lines.E_T.agg(["min", "max"])
    return along_E.loc[lines.amplitude.idxmax(), _HIGHEST].merge(summed, on=line)[SUMMARY]
