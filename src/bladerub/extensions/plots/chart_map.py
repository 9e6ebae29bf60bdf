"""One quantity of the chart over E and K: colours, contour lines, the paper's coatings and the ridge."""

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import LogLocator, MaxNLocator

from bladerub.extensions.plots.chart_panel import Grid, colour, mark_paper, over_moduli, panels
from bladerub.plots.style import DARK, HEIGHT_MAP, PAGE, new_figure, styled


class Quantity(NamedTuple):
    """How a column of the chart is drawn.

    `label` has the unit of the figure, `factor` is from SI to that unit, `ridge` is the column whose maxima
    the ridge joins. Colours are `logarithmic` for amplitudes and volumes, which spread over decades.
    """

    label: str
    factor: float
    ridge: str
    logarithmic: bool


QUANTITIES = {
    "Y4": Quantity("$Y_4$ (mm)", 1e3, "Y4", True),
    "f4": Quantity("rotational frequency $f_4$ (normalised)", 1.0, "Y4", False),
    "Y6": Quantity("$Y_6$ (mm)", 1e3, "Y6", True),
    "f6": Quantity("rotational frequency $f_6$ (normalised)", 1.0, "Y6", False),
    "peak": Quantity("greatest radial displacement of node 1 (mm)", 1e3, "peak", True),
    "worn_volume": Quantity("greatest worn volume (cm³)", 1e6, "worn_volume", True),
    "divergent_share": Quantity("share of divergent speeds (%)", 100.0, "peak", False),
}
"""What is drawn, by column of ``chart.csv``."""


@styled
def chart_map(chart: pd.DataFrame, quantity: str) -> Figure:
    """Draw one of `QUANTITIES`, a column of ``chart.csv``, for each θ."""
    about = QUANTITIES[quantity]
    norm = _norm(chart[quantity] * about.factor, about.logarithmic)
    figure = new_figure(PAGE, 0.58 * PAGE)
    drawn = panels(figure, chart)
    for axes, rows in drawn:
        grid = over_moduli(rows.assign(drawn=rows[quantity] * about.factor), "drawn")
        mesh = colour(axes, grid, cmap=HEIGHT_MAP, norm=norm)
        _contours(axes, grid, norm)
        mark_paper(axes, rows)
        _ridge(axes, over_moduli(rows, about.ridge))
    bar = figure.colorbar(
        mesh, ax=[axes for axes, _ in drawn], label=about.label, location="bottom", aspect=50
    )
    if about.logarithmic:
        bar.locator = LogLocator(subs=(1, 2, 5))
        bar.formatter = "{x:g}"
        bar.minorticks_off()
    figure.legend(handles=_keys(about), loc="outside upper center", ncols=2)
    return figure


def _norm(values: pd.Series, logarithmic: bool) -> Normalize:
    positive = values[values > 0]
    if logarithmic and not positive.empty:
        return LogNorm(positive.min(), positive.max())
    return Normalize(values.min(), values.max())


def _contours(axes: Axes, grid: Grid, norm: Normalize) -> None:
    if norm.vmin == norm.vmax or min(grid.values.shape) < 2:
        return
    locator = LogLocator(subs=(1, 2, 5)) if isinstance(norm, LogNorm) else MaxNLocator(6)
    levels = [level for level in locator.tick_values(norm.vmin, norm.vmax) if norm.vmin < level < norm.vmax]
    if levels:
        lines = axes.contour(grid.E, grid.K, grid.values.T, levels=levels, colors="white", linewidths=0.8)
        axes.clabel(lines, fontsize=6.5, fmt="%g")


def _ridge(axes: Axes, grid: Grid) -> None:
    """Join the K of the greatest value for each E that has one."""
    highest = np.nan_to_num(grid.values, nan=-np.inf)
    exists = highest.max(axis=1) > 0
    along, across = grid.E[exists], grid.K[highest.argmax(axis=1)][exists]
    axes.plot(along, across, color="white", linewidth=3)
    axes.plot(along, across, **_RIDGE)


_RIDGE = {"color": DARK, "linewidth": 1.3, "marker": "s", "markersize": 2.2}
_RIDGE_OF = {"Y4": "$Y_4$", "Y6": "$Y_6$", "peak": "displacement", "worn_volume": "worn volume"}


def _keys(about: Quantity) -> list[Line2D]:
    ridge = f"ridge: for each E the K of the greatest {_RIDGE_OF[about.ridge]}"
    paper = {"marker": "o", "ms": 3.5, "mfc": "white", "mec": DARK, "mew": 0.5, "ls": "none"}
    return [Line2D([], [], **_RIDGE, label=ridge), Line2D([], [], **paper, label="the paper's coatings")]
