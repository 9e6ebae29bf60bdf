"""Height of the peaks against contact stiffness, dissipated energy and lobes: along the ridge and across."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extensions.plots.chart_panel import label_1_2_5
from bladerub.plots.style import FIRST, GREY, PAGE, SECOND, new_figure, styled

_AGAINST = {
    "E_T": "contact stiffness $E_T = EK/(E+K)$",
    "wear_per_cycle": "wear energy per cycle (J)",
    "lobes": "worn lobes",
}
_POINTS = {"color": GREY, "markersize": 2.5, "markeredgecolor": "none", "label": "all coatings"}
_LOOK = {"linewidth": 0.9, "markersize": 3}
_RIDGE = {**FIRST, **_LOOK, "marker": "s", "label": "on the ridge, by E"}
_ACROSS = {**SECOND, **_LOOK, "marker": "^", "label": "across its highest cell, by K"}


@styled
def chart_explanation(peaks: pd.DataFrame) -> Figure:
    """Draw Y_k of ``chart_explanation.csv`` against three quantities, a row for each order and θ.

    The ridge is the points of the greatest Y_k for each E; the column of the E at which it is highest runs
    across it.
    """
    groups = list(peaks.groupby(["order", "theta"]))
    figure = new_figure(PAGE, 0.27 * PAGE * len(groups) + 0.4)
    rows = figure.subplots(len(groups), len(_AGAINST), sharey="row", sharex="col", squeeze=False)
    for row, ((order, theta), points) in zip(rows, groups, strict=True):
        for axes, column in zip(row, _AGAINST, strict=True):
            _draw(axes, points, column)
        row[0].set_ylabel(f"$Y_{order}$ (mm)")
        row[0].set_title(rf"$\theta$ = {theta:g} rad", fontsize=8)
    for axes, label in zip(rows[-1], _AGAINST.values(), strict=True):
        axes.set_xlabel(label)
    figure.legend(*rows[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _draw(axes: Axes, points: pd.DataFrame, column: str) -> None:
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
