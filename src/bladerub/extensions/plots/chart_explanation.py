"""Height of the peaks against contact stiffness, dissipated energy and lobes: along the ridge and across."""

from __future__ import annotations

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from bladerub.plots.style import FIRST, GREY, PAGE, SECOND, new_figure, styled

_AGAINST = {
    "E_T": "contact stiffness $E_T = EK/(E+K)$",
    "wear_per_cycle": "wear energy per cycle (J)",
    "lobes": "worn lobes",
}
_RIDGE = {**FIRST, "linewidth": 0.9, "marker": "s", "markersize": 3, "label": "on the ridge, by E"}
_ACROSS = {
    **SECOND,
    "linewidth": 0.9,
    "marker": "^",
    "markersize": 3,
    "label": "across its highest cell, by K",
}


@styled
def chart_explanation(peaks: pd.DataFrame) -> Figure:
    """Draw Y_k of all cells against each of three quantities, a row for each order and θ.

    The ridge is the cells of the greatest Y_k for each E; across it runs the column of cells of the E at
    which it is highest.

    Parameters
    ----------
    peaks : DataFrame
        Rows of ``chart_explanation.csv``.
    """
    groups = list(peaks.groupby(["order", "theta"]))
    figure = new_figure(PAGE, 0.27 * PAGE * len(groups) + 0.4)
    rows = figure.subplots(len(groups), len(_AGAINST), sharey="row", sharex="col", squeeze=False)
    for row, ((order, theta), cells) in zip(rows, groups, strict=True):
        for axes, column in zip(row, _AGAINST, strict=True):
            _draw(axes, cells, column)
        row[0].set_ylabel(f"$Y_{order}$ (mm)")
        row[0].set_title(rf"$\theta$ = {theta:g} rad", fontsize=8)
    for axes, label in zip(rows[-1], _AGAINST.values(), strict=True):
        axes.set_xlabel(label)
    figure.legend(*rows[0][0].get_legend_handles_labels(), loc="outside upper center", ncols=3)
    return figure


def _draw(axes: Axes, cells: pd.DataFrame, column: str) -> None:
    ridge = cells.loc[cells.groupby("E").amplitude.idxmax()].sort_values("E")
    top = ridge.loc[ridge.amplitude.idxmax()]
    across = cells[cells.E == top.E].sort_values("K")
    axes.plot(cells[column], 1e3 * cells.amplitude, ".", color=GREY, ms=2.5, mec="none", label="all coatings")
    for rows, look in ((ridge, _RIDGE), (across, _ACROSS)):
        joined = {"linestyle": "none"} if column == "lobes" else {}
        axes.plot(rows[column], 1e3 * rows.amplitude, **look | joined)
    axes.set_yscale("log")
    axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axes.yaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.grid(True)
    if column != "lobes":
        axes.set_xscale("log")
