"""The peaks of the chart against what goes with them, and their coatings against the wear."""

from itertools import cycle

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from bladerub.extras.chart.stiffening import is_stiffened
from bladerub.plots import titles
from bladerub.plots.style import DARK, FIRST, GREY, ORANGE, PAGE, SECOND, new_figure, styled

_POINTS = {"color": GREY, "markersize": 2.5, "markeredgecolor": "none", "label": "all coatings"}
_LOOK = {"linewidth": 0.9, "markersize": 3}
_RIDGE = {**FIRST, **_LOOK, "marker": "s", "label": "on the ridge, by E"}
_ACROSS = {**SECOND, **_LOOK, "marker": "^", "label": "across its highest cell, by K"}


def _tangent_modulus(unit: float) -> str:
    return f"$E_T = EK/(E+K)$ ({titles.in_units(unit)})"


@styled
def chart_explanation(peaks: pd.DataFrame, unit: float) -> Figure:
    """Draw Y_k of ``chart_explanation.csv`` against three quantities, a row for each order and θ.

    The ridge is the points of the greatest Y_k for each E; the column of the E at which it is highest runs
    across it. E = 1 is `unit`, Pa.
    """
    groups = list(peaks.groupby(["order", "theta"]))
    labels = {
        "E_T": _tangent_modulus(unit),
        "wear_per_cycle": "wear energy per cycle (J)",
        "lobes": "worn lobes",
    }
    figure = new_figure(PAGE, 0.27 * PAGE * len(groups) + 0.4)
    rows = figure.subplots(len(groups), len(labels), sharey="row", sharex="col", squeeze=False)
    for row, ((order, theta), points) in zip(rows, groups, strict=True):
        for axes, column in zip(row, labels, strict=True):
            _draw(axes, points.dropna(subset=["amplitude"]), column)
        row[0].set_ylabel(f"$Y_{{{order}}}$ (mm)")
        row[0].set_title(rf"$\theta$ = {theta:g} rad", fontsize=8)
    for axes, label in zip(rows[-1], labels.values(), strict=True):
        axes.set_xlabel(label)
    figure.legend(*rows[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _draw(axes: Axes, points: pd.DataFrame, column: str) -> None:
    if points.empty:
        axes.text(0.5, 0.5, "no coating has a peak", transform=axes.transAxes, ha="center", fontsize=8)
        return
    ridge = points.loc[points.groupby("E").amplitude.idxmax()].sort_values("E")
    top = ridge.loc[ridge.amplitude.idxmax()]
    across = points[points.E == top.E].sort_values("K")
    axes.plot(points[column], 1e3 * points.amplitude, ".", **_POINTS)
    for rows, look in ((ridge, _RIDGE), (across, _ACROSS)):
        joined = {"linestyle": "none"} if column == "lobes" else {}
        axes.plot(rows[column], 1e3 * rows.amplitude, **look | joined)
    axes.set_yscale("log")
    label_1_2_5(axes.yaxis)
    axes.grid(True)
    if column != "lobes":
        axes.set_xscale("log")


_LOOKS = ({"marker": "o", "color": DARK, "ms": 2.4}, {"marker": "^", "color": ORANGE, "ms": 3.2})


@styled
def chart_stiffening(peaks: pd.DataFrame, summary: pd.DataFrame, unit: float) -> Figure:
    """Draw f_k of all points of ``chart_explanation.csv`` over E_T, a panel for each order.

    `summary` is from `bladerub.extras.chart.stiffening.table`; E = 1 is `unit`, Pa.
    """
    orders = sorted(peaks.order.unique())
    figure = new_figure(PAGE, 0.52 * PAGE)
    row = figure.subplots(1, len(orders), squeeze=False)[0]
    correlation = summary.set_index(["order", "theta"]).rank_correlation_E_T
    for index, (axes, order) in enumerate(zip(row, orders, strict=True)):
        of_order = peaks[peaks.order == order]
        for (theta, points), look in zip(of_order.groupby("theta"), cycle(_LOOKS), strict=False):
            stiffened, others = points[is_stiffened(points)], points[~is_stiffened(points)]
            marks = {"ls": "none", "mew": 0.5, **look}
            rank = correlation[order, theta]
            label = rf"$\theta$ = {theta:g} rad" + ("" if pd.isna(rank) else f", rank correlation {rank:.2f}")
            axes.plot(stiffened.E_T, stiffened.f_peak, **marks, mec="none", label=label)
            axes.plot(others.E_T, others.f_peak, **marks | {"mfc": "none", "color": GREY})
        axes.axhline(of_order.f_crossing.mean(), color=GREY, lw=0.9, ls="--", label="crossing with $C_1$")
        axes.set(xscale="log", xlabel=_tangent_modulus(unit), ylabel=f"$f_{{{order}}}$")
        axes.set_title(titles.panel(index, f"eo({order})"), pad=38)
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), fontsize=7, borderaxespad=0.1)
        axes.grid(True)
    return figure


_LABELLED = 6  # coatings of a front that are named; the table has all


@styled
def chart_pareto(chart: pd.DataFrame, front: pd.DataFrame) -> Figure:
    """Draw for each θ the greatest displacement against the greatest worn volume.

    `chart` is ``chart.csv``, `front` is from `bladerub.extras.chart.choice.pareto`.
    """
    angles = sorted(chart.theta.unique())
    chart, front = (rows[rows.worn_volume > 0] for rows in (chart, front))  # for the logarithmic axis
    figure = new_figure(PAGE, 0.5 * PAGE)
    row = figure.subplots(1, len(angles), sharex=True, sharey=True, squeeze=False)[0]
    for index, (axes, theta) in enumerate(zip(row, angles, strict=True)):
        coatings, best = chart[chart.theta == theta], front[front.theta == theta]
        axes.plot(*_coordinates(coatings), ".", color=GREY, ms=3, mec="none", label="coatings of the chart")
        axes.plot(*_coordinates(best), "-s", color=DARK, ms=3.5, lw=1, label="bettered by none in both")
        safe = best[best.safe]
        look = {"mfc": ORANGE, "mec": DARK, "ms": 5, "ls": "none", "label": "of these, within all limits"}
        axes.plot(*_coordinates(safe), "s", **look)
        for place in _labelled(best, chart):
            coating = best.iloc[place]
            name, note = f"E {coating.E:g}, K {coating.K:g}", {"textcoords": "offset points", "fontsize": 6.5}
            axes.annotate(name, _coordinates(coating), (5, 4), **note)
        axes.set(xscale="log", yscale="log", xlabel="greatest displacement of node 1 (mm)")
        label_1_2_5(axes.xaxis)
        axes.set_title(titles.panel(index, rf"$\theta$ = {theta:g} rad"))
        axes.grid(True)
    row[0].set_ylabel("greatest worn volume (cm³)")
    figure.legend(*row[0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _labelled(front: pd.DataFrame, chart: pd.DataFrame) -> list[int]:
    """Return the places in `front` of coatings that are evenly spaced along it, as it is drawn."""
    if front.empty:
        return []
    sides = [np.ptp(np.log(values)) for values in _coordinates(chart)]
    steps = [np.diff(np.log(values)) / side for values, side in zip(_coordinates(front), sides, strict=True)]
    along = np.append(0, np.cumsum(np.hypot(*steps)))
    positions = np.linspace(0, along[-1], _LABELLED)
    return np.unique(np.abs(np.subtract.outer(along, positions)).argmin(axis=0)).tolist()


def _coordinates(rows: pd.DataFrame | pd.Series) -> tuple:
    """Return displacement and worn volume of rows, or of one, as they are drawn: mm and cm³."""
    return 1e3 * rows.peak, 1e6 * rows.worn_volume


def label_1_2_5(axis: Axis) -> None:
    """Label a logarithmic axis at 1, 2 and 5 times the powers of ten, in plain numbers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())
