"""The chart of coatings: quantities and kept limits over E and K, the peaks against what goes with them."""

from itertools import cycle
from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import QuadMesh
from matplotlib.colors import ListedColormap, LogNorm, Normalize
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter, StrMethodFormatter

from bladerub.extras.chart.settings import Limits
from bladerub.extras.chart.stiffening import is_stiffened
from bladerub.plots import style, titles
from bladerub.plots.maps import edges

PAPER_E = (0.11, 0.2, 0.5, 1.1, 1.5, 2.0, 5.0, 11.0, 20.0)  # moduli of the paper's Figs. 11 to 14,
PAPER_K = (0.05, 0.1, 0.5, 1.0, 5.0, 10.0)  # which make 54 coatings
LETTERS = {"amplitude": "A", "wear": "W", "divergent_share": "D", "fatigue": "F"}  # of exceeded limits
_SHADES = ["#ffffff", "#f3d9a4", "#e08e0b", "#8f4b08", "#4d2604"]  # from none to all limits exceeded
_PAPER = {"marker": "o", "mfc": "white", "mec": style.DARK, "mew": 0.5, "ls": "none"}
_RIDGE = {"color": style.DARK, "linewidth": 1.3, "marker": "s", "markersize": 2.2}
_RIDGE_OF = {"peak": "displacement", "worn_volume": "worn volume"}

_POINTS = {"color": style.GREY, "markersize": 2.5, "markeredgecolor": "none", "label": "all coatings"}
_LOOK = {"linewidth": 0.9, "markersize": 3}
_ON_RIDGE = {**style.FIRST, **_LOOK, "marker": "s", "label": "on the ridge, by E"}
_ACROSS = {**style.SECOND, **_LOOK, "marker": "^", "label": "across its highest cell, by K"}
_LOOKS = ({"marker": "o", "color": style.DARK, "ms": 2.4}, {"marker": "^", "color": style.ORANGE, "ms": 3.2})
_LABELLED = 6  # coatings of a front that are named; the table has all


class Quantity(NamedTuple):
    """How a column of the chart is drawn."""

    label: str  # with the unit of the figure
    factor: float  # from SI to that unit
    ridge: str  # the column whose maxima the ridge joins
    logarithmic: bool  # colours of amplitudes and volumes, which spread over decades


QUANTITIES = {  # drawn besides Y_k and f_k of each engine order, by column of ``chart.csv``
    "peak": Quantity("greatest radial displacement of node 1 (mm)", 1e3, "peak", True),
    "worn_volume": Quantity("greatest worn volume (cm³)", 1e6, "worn_volume", True),
    "divergent_share": Quantity("share of divergent speeds (%)", 100.0, "peak", False),
}


def drawn_quantity(column: str) -> Quantity:
    """Say how a column of ``chart.csv`` is drawn: one of `QUANTITIES`, or ``Y4``, ``f4`` and so on."""
    if column in QUANTITIES:
        return QUANTITIES[column]
    name, order = column[0], column[1:]
    if name == "Y":
        return Quantity(f"$Y_{{{order}}}$ (mm)", 1e3, column, True)
    return Quantity(f"rotational frequency $f_{{{order}}}$ (normalised)", 1.0, f"Y{order}", False)


@style.styled
def chart_map(chart: pd.DataFrame, quantity: str, unit: float) -> Figure:
    """Draw a column of ``chart.csv``, see `drawn_quantity`, for each θ; E = 1 and K = 1 are `unit`, Pa."""
    about = drawn_quantity(quantity)
    norm = _norm(chart[quantity] * about.factor, about.logarithmic)
    figure = style.new_figure(style.PAGE, 0.58 * style.PAGE)
    for axes, rows in _panels(figure, chart, unit):
        grid = _over_moduli(rows.assign(drawn=rows[quantity] * about.factor), "drawn")
        mesh = _colour(axes, grid, cmap=style.HEIGHT_MAP, norm=norm)
        _contours(axes, grid, norm)
        _mark_paper(axes, rows)
        _ridge(axes, _over_moduli(rows, about.ridge))
    bar = figure.colorbar(mesh, ax=figure.axes, label=about.label, location="bottom", aspect=50)
    if about.logarithmic:
        bar.locator = LogLocator(subs=(1, 2, 5))
        bar.formatter = "{x:g}"
        bar.minorticks_off()
    highest = _RIDGE_OF.get(about.ridge, f"$Y_{{{about.ridge[1:]}}}$")
    ridge = Line2D([], [], label=f"ridge: for each E the K of the greatest {highest}", **_RIDGE)
    paper = Line2D([], [], ms=3.5, label="the paper's coatings", **_PAPER)
    figure.legend(handles=[ridge, paper], loc="outside upper center", ncols=2)
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
    ridge = grid.loc[:, grid.max() > 0].idxmax()
    axes.plot(ridge.index, ridge, color="white", linewidth=3)
    axes.plot(ridge.index, ridge, **_RIDGE)


@style.styled
def chart_safe(chart: pd.DataFrame, broken: pd.DataFrame, limits: Limits, unit: float) -> Figure:
    """Draw for each θ which rows of ``chart.csv`` exceed which `limits`; E = 1 is `unit`, Pa."""
    lettered = broken.rename(columns=LETTERS)
    judged = chart.assign(broken=broken.sum(axis=1), letters=lettered.dot(lettered.columns))
    figure = style.new_figure(style.PAGE, 0.55 * style.PAGE)
    for axes, rows in _panels(figure, judged, unit):
        shades = _SHADES[: len(broken.columns) + 1]
        grid, colours = _over_moduli(rows, "broken"), ListedColormap(shades)
        _colour(axes, grid, cmap=colours, vmin=-0.5, vmax=len(shades) - 0.5, edgecolors="white", lw=0.2)
        size = min(7.0, 75 / max(grid.shape))
        for row in rows.itertuples():
            shade = "white" if row.broken >= len(LETTERS) - 1 else style.DARK
            axes.text(row.E, row.K, row.letters, ha="center", va="center", fontsize=size, color=shade)
        _mark_paper(axes, rows[rows.broken == 0])
    words = [
        f"A: displacement above {1e3 * limits.amplitude:g} mm",
        f"W: wear deeper than {1e3 * limits.wear:g} mm",
        f"D: more than {100 * limits.divergent_share:g} % of the speeds diverge",
    ]
    if limits.fatigue is not None:
        words.append(f"F: alternating stress above {limits.fatigue / 1e6:g} MPa")
    safe = Patch(facecolor=_SHADES[0], edgecolor=style.DARK, linewidth=0.5, label="all limits kept")
    keys = [safe, *(Patch(facecolor="none", label=text) for text in words)]
    figure.legend(handles=keys, loc="outside lower center", ncols=2)
    return figure


def _panels(figure: Figure, chart: pd.DataFrame, unit: float) -> list[tuple[Axes, pd.DataFrame]]:
    """Make a panel for each θ of the chart, side by side; return each with the rows of its θ."""
    of_angle = list(chart.groupby("theta"))
    row, labels = figure.subplots(1, len(of_angle), sharey=True, squeeze=False)[0], titles.moduli_axes(unit)
    for index, (axes, (theta, _)) in enumerate(zip(row, of_angle, strict=True)):
        axes.set_title(titles.panel(index, rf"$\theta$ = {theta:g} rad"))
        axes.set(xscale="log", yscale="log", xlabel=labels["xlabel"], facecolor=style.MISSING)
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


def _tangent_modulus(unit: float) -> str:
    return f"$E_T = EK/(E+K)$ ({titles.in_units(unit)})"


@style.styled
def chart_explanation(peaks: pd.DataFrame, unit: float) -> Figure:
    """Draw Y_k of ``chart_explanation.csv`` against three quantities, a row for each order and θ.

    The ridge is the points of the greatest Y_k for each E; the column of the E at which it is highest runs
    across it. E = 1 is `unit`, Pa.
    """
    groups = list(peaks.groupby(["order", "theta"]))
    labels = {"E_T": _tangent_modulus(unit), "wear_per_cycle": "wear energy per cycle (J)"}
    labels["lobes"] = "worn lobes"
    figure = style.new_figure(style.PAGE, 0.27 * style.PAGE * len(groups) + 0.4)
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
    joined = {"linestyle": "none"} if column == "lobes" else {}
    for rows, look in ((ridge, _ON_RIDGE), (across, _ACROSS)):
        axes.plot(rows[column], 1e3 * rows.amplitude, **look | joined)
    axes.set_yscale("log")
    _label_1_2_5(axes.yaxis)
    axes.grid(True)
    if column != "lobes":
        axes.set_xscale("log")


@style.styled
def chart_stiffening(peaks: pd.DataFrame, summary: pd.DataFrame, unit: float) -> Figure:
    """Draw f_k of ``chart_explanation.csv`` over E_T by order; `summary` is of this, E = 1 is `unit`, Pa."""
    orders = sorted(peaks.order.unique())
    figure = style.new_figure(style.PAGE, 0.52 * style.PAGE)
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
            axes.plot(others.E_T, others.f_peak, **marks | {"mfc": "none", "color": style.GREY})
        look = {"color": style.GREY, "lw": 0.9, "ls": "--", "label": "crossing with $C_1$"}
        axes.axhline(of_order.f_crossing.mean(), **look)
        axes.set(xscale="log", xlabel=_tangent_modulus(unit), ylabel=f"$f_{{{order}}}$")
        axes.set_title(titles.panel(index, f"eo({order})"), pad=38)
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), fontsize=7, borderaxespad=0.1)
        axes.grid(True)
    return figure


@style.styled
def chart_pareto(chart: pd.DataFrame, front: pd.DataFrame) -> Figure:
    """Draw the greatest displacement over worn volume in ``chart.csv`` for each θ; `front` is of `pareto`."""
    angles = sorted(chart.theta.unique())
    chart, front = (rows[rows.worn_volume > 0] for rows in (chart, front))  # for the logarithmic axis
    figure = style.new_figure(style.PAGE, 0.5 * style.PAGE)
    row = figure.subplots(1, len(angles), sharex=True, sharey=True, squeeze=False)[0]
    for index, (axes, theta) in enumerate(zip(row, angles, strict=True)):
        coatings, best = chart[chart.theta == theta], front[front.theta == theta]
        look = {"color": style.GREY, "ms": 3, "mec": "none", "label": "coatings of the chart"}
        axes.plot(*_coordinates(coatings), ".", **look)
        axes.plot(*_coordinates(best), "-s", color=style.DARK, ms=3.5, lw=1, label="bettered by none in both")
        look = {"mfc": style.ORANGE, "mec": style.DARK, "ms": 5, "ls": "none"}
        axes.plot(*_coordinates(best[best.safe]), "s", **look, label="of these, within all limits")
        for place in _labelled(best, chart):
            coating = best.iloc[place]
            name, note = f"E {coating.E:g}, K {coating.K:g}", {"textcoords": "offset points", "fontsize": 6.5}
            axes.annotate(name, _coordinates(coating), (5, 4), **note)
        axes.set(xscale="log", yscale="log", xlabel="greatest displacement of node 1 (mm)")
        _label_1_2_5(axes.xaxis)
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


def _label_1_2_5(axis: Axis) -> None:
    """Label a logarithmic axis at 1, 2 and 5 times the powers of ten, in plain numbers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())
