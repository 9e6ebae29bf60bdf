"""Panels of the chart: one quantity over both moduli, on logarithmic axes, and the paper's coatings."""

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullFormatter, StrMethodFormatter

from bladerub.plots import titles
from bladerub.plots.bins import edges
from bladerub.plots.style import DARK, MISSING

PAPER_E = (0.11, 0.2, 0.5, 1.1, 1.5, 2.0, 5.0, 11.0, 20.0)
PAPER_K = (0.05, 0.1, 0.5, 1.0, 5.0, 10.0)
"""Moduli of the paper's Figs. 11 to 14, which make 54 coatings."""


class Grid(NamedTuple):
    """One quantity of the chart at one θ: `values` (n_E, n_K) over ascending moduli, NaN without a point."""

    E: np.ndarray
    K: np.ndarray
    values: np.ndarray


def over_moduli(rows: pd.DataFrame, column: str) -> Grid:
    """Arrange `column` of the rows of one casing and θ over E and K."""
    wide = rows.pivot(index="E", columns="K", values=column)
    return Grid(wide.index.to_numpy(), wide.columns.to_numpy(), wide.to_numpy(dtype=float))


def panels(figure: Figure, chart: pd.DataFrame) -> list[tuple[Axes, pd.DataFrame]]:
    """Make a panel for each θ of the chart, side by side; return each with the rows of its θ."""
    angles = sorted(chart.theta.unique())
    row = figure.subplots(1, len(angles), sharey=True, squeeze=False)[0]
    for index, (axes, theta) in enumerate(zip(row, angles, strict=True)):
        axes.set_title(titles.panel(index, rf"$\theta$ = {theta:g} rad"))
        axes.set(xscale="log", yscale="log", xlabel="Young modulus E (normalised)", facecolor=MISSING)
    row[0].set_ylabel("plastic modulus K (normalised)")
    return [(axes, chart[chart.theta == theta]) for axes, theta in zip(row, angles, strict=True)]


def colour(axes: Axes, grid: Grid, **look) -> QuadMesh:
    """Colour a rectangle for each point of the grid; `look` is that of matplotlib's ``pcolormesh``."""
    return axes.pcolormesh(
        10 ** edges(np.log10(grid.E)),
        10 ** edges(np.log10(grid.K)),
        np.ma.masked_invalid(grid.values.T),
        rasterized=True,
        **look,
    )


def mark_paper(axes: Axes, rows: pd.DataFrame) -> None:
    """Mark those of the rows that are the paper's coatings with a dot."""
    marked = rows[rows.E.isin(PAPER_E) & rows.K.isin(PAPER_K)]
    axes.plot(marked.E, marked.K, "o", ms=2.4, mfc="white", mec=DARK, mew=0.5, ls="none")


def label_1_2_5(axis: Axis) -> None:
    """Label a logarithmic axis at 1, 2 and 5 times the powers of ten, in plain numbers."""
    axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    axis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axis.set_minor_formatter(NullFormatter())
