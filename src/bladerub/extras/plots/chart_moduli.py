"""The chart over E and K: one quantity with contours, the paper's coatings and the ridge; the limits kept."""

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, MaxNLocator

from bladerub.extras.chart.settings import Limits
from bladerub.plots import titles
from bladerub.plots.maps import edges
from bladerub.plots.style import DARK, HEIGHT_MAP, MISSING, PAGE, new_figure, styled

PAPER_E = (0.11, 0.2, 0.5, 1.1, 1.5, 2.0, 5.0, 11.0, 20.0)
PAPER_K = (0.05, 0.1, 0.5, 1.0, 5.0, 10.0)
"""Moduli of the paper's Figs. 11 to 14, which make 54 coatings."""

LETTERS = {"amplitude": "A", "wear": "W", "divergent_share": "D", "fatigue": "F"}
"""Letter of each limit, written where it is exceeded."""
_SHADES = ["#ffffff", "#f3d9a4", "#e08e0b", "#8f4b08", "#4d2604"]
"""From none to all limits exceeded, the last where the stress is limited too."""

_PAPER = {"marker": "o", "mfc": "white", "mec": DARK, "mew": 0.5, "ls": "none"}
_RIDGE = {"color": DARK, "linewidth": 1.3, "marker": "s", "markersize": 2.2}
_RIDGE_OF = {"peak": "displacement", "worn_volume": "worn volume"}


class Quantity(NamedTuple):
    """How a column of the chart is drawn."""

    label: str  # with the unit of the figure
    factor: float  # from SI to that unit
    ridge: str  # the column whose maxima the ridge joins
    logarithmic: bool  # colours of amplitudes and volumes, which spread over decades


QUANTITIES = {
    "peak": Quantity("greatest radial displacement of node 1 (mm)", 1e3, "peak", True),
    "worn_volume": Quantity("greatest worn volume (cm³)", 1e6, "worn_volume", True),
    "divergent_share": Quantity("share of divergent speeds (%)", 100.0, "peak", False),
}
"""What is drawn besides Y_k and f_k of each engine order, by column of ``chart.csv``."""


def drawn_quantity(column: str) -> Quantity:
    """Say how a column of ``chart.csv`` is drawn: one of `QUANTITIES`, or ``Y4``, ``f4`` and so on."""
    if column in QUANTITIES:
        return QUANTITIES[column]
    name, order = column[0], column[1:]
    if name == "Y":
        return Quantity(f"$Y_{{{order}}}$ (mm)", 1e3, column, True)
    return Quantity(f"rotational frequency $f_{{{order}}}$ (normalised)", 1.0, f"Y{order}", False)


@styled
def chart_map(chart: pd.DataFrame, quantity: str, unit: float) -> Figure:
    """Draw a column of ``chart.csv``, see `drawn_quantity`, for each θ; E = 1 and K = 1 are `unit`, Pa."""
    about = drawn_quantity(quantity)
    norm = _norm(chart[quantity] * about.factor, about.logarithmic)
    figure = new_figure(PAGE, 0.58 * PAGE)
    for axes, rows in _panels(figure, chart, unit):
        grid = _over_moduli(rows.assign(drawn=rows[quantity] * about.factor), "drawn")
        mesh = _colour(axes, grid, cmap=HEIGHT_MAP, norm=norm)
        _contours(axes, grid, norm)
        _mark_paper(axes, rows)
        _ridge(axes, _over_moduli(rows, about.ridge))
    bar = figure.colorbar(mesh, ax=figure.axes, label=about.label, location="bottom", aspect=50)
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
    return Normalize(*((values.min(), values.max()) if values.notna().any() else (0.0, 1.0)))


def _contours(axes: Axes, grid: pd.DataFrame, norm: Normalize) -> None:
    if norm.vmin == norm.vmax or min(grid.shape) < 2:
        return
    locator = LogLocator(subs=(1, 2, 5)) if isinstance(norm, LogNorm) else MaxNLocator(6)
    levels = [level for level in locator.tick_values(norm.vmin, norm.vmax) if norm.vmin < level < norm.vmax]
    if levels:
        lines = axes.contour(grid.columns, grid.index, grid, levels=levels, colors="white", linewidths=0.8)
        axes.clabel(lines, fontsize=6.5, fmt="%g")


def _ridge(axes: Axes, grid: pd.DataFrame) -> None:
    """Join the K of the greatest value for each E that has one."""
    grid = grid.loc[:, grid.max() > 0]
    along, across = grid.columns, grid.idxmax()
    axes.plot(along, across, color="white", linewidth=3)
    axes.plot(along, across, **_RIDGE)


def _keys(about: Quantity) -> list[Line2D]:
    highest = _RIDGE_OF.get(about.ridge, f"$Y_{{{about.ridge[1:]}}}$")
    ridge = f"ridge: for each E the K of the greatest {highest}"
    paper = Line2D([], [], ms=3.5, label="the paper's coatings", **_PAPER)
    return [Line2D([], [], label=ridge, **_RIDGE), paper]


@styled
def chart_safe(chart: pd.DataFrame, broken: pd.DataFrame, limits: Limits, unit: float) -> Figure:
    """Draw for each θ which coatings of ``chart.csv`` exceed which of the `limits`.

    `broken` is for the same rows, from `bladerub.extras.chart.choice.broken_limits`; E = 1 is `unit`, Pa.
    """
    lettered = broken.rename(columns=LETTERS)
    judged = chart.assign(broken=broken.sum(axis=1), letters=lettered.dot(lettered.columns))
    figure = new_figure(PAGE, 0.55 * PAGE)
    for axes, rows in _panels(figure, judged, unit):
        shades = _SHADES[: len(broken.columns) + 1]
        grid, colours = _over_moduli(rows, "broken"), ListedColormap(shades)
        _colour(axes, grid, cmap=colours, vmin=-0.5, vmax=len(shades) - 0.5, edgecolors="white", lw=0.2)
        size = min(7.0, 75 / max(grid.shape))
        for row in rows.itertuples():
            shade = "white" if row.broken >= len(LETTERS) - 1 else DARK
            axes.text(row.E, row.K, row.letters, ha="center", va="center", fontsize=size, color=shade)
        _mark_paper(axes, rows[rows.broken == 0])
    figure.legend(handles=_limit_keys(limits), loc="outside lower center", ncols=2)
    return figure


def _limit_keys(limits: Limits) -> list[Patch]:
    words = {
        "amplitude": f"A: displacement above {1e3 * limits.amplitude:g} mm",
        "wear": f"W: wear deeper than {1e3 * limits.wear:g} mm",
        "divergent_share": f"D: more than {100 * limits.divergent_share:g} % of the speeds diverge",
    }
    if limits.fatigue is not None:
        words["fatigue"] = f"F: alternating stress above {limits.fatigue / 1e6:g} MPa"
    safe = Patch(facecolor=_SHADES[0], edgecolor=DARK, linewidth=0.5, label="all limits kept")
    return [safe, *(Patch(facecolor="none", label=text) for text in words.values())]


def _panels(figure: Figure, chart: pd.DataFrame, unit: float) -> list[tuple[Axes, pd.DataFrame]]:
    """Make a panel for each θ of the chart, side by side; return each with the rows of its θ."""
    of_angle = list(chart.groupby("theta"))
    row, labels = figure.subplots(1, len(of_angle), sharey=True, squeeze=False)[0], titles.moduli_axes(unit)
    for index, (axes, (theta, _)) in enumerate(zip(row, of_angle, strict=True)):
        axes.set_title(titles.panel(index, rf"$\theta$ = {theta:g} rad"))
        axes.set(xscale="log", yscale="log", xlabel=labels["xlabel"], facecolor=MISSING)
    row[0].set_ylabel(labels["ylabel"])
    return [(axes, rows) for axes, (_, rows) in zip(row, of_angle, strict=True)]


def _over_moduli(rows: pd.DataFrame, column: str) -> pd.DataFrame:
    """Arrange `column` of the rows of one casing and θ over K (rows) and E (columns)."""
    return rows.pivot(index="K", columns="E", values=column).astype(float)


def _colour(axes: Axes, grid: pd.DataFrame, **look) -> QuadMesh:
    """Colour a rectangle for each point of the grid; `look` is that of matplotlib's ``pcolormesh``."""
    sides = (10 ** edges(np.log10(moduli)) for moduli in (grid.columns, grid.index))
    return axes.pcolormesh(*sides, np.ma.masked_invalid(grid), rasterized=True, **look)


def _mark_paper(axes: Axes, rows: pd.DataFrame) -> None:
    """Mark those of the rows that are the paper's coatings with a dot."""
    marked = rows[rows.E.isin(PAPER_E) & rows.K.isin(PAPER_K)]
    axes.plot(marked.E, marked.K, ms=2.4, **_PAPER)
