"""Amplitude against wear: every coating of the chart, and those to which no other is better in both."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.extras.plots.chart_peaks import label_1_2_5
from bladerub.plots import titles
from bladerub.plots.style import DARK, GREY, ORANGE, PAGE, new_figure, styled

_LABELLED = 6
"""Coatings of a front that are named; the table has all."""


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
    return sorted(
        {int(np.abs(along - position).argmin()) for position in np.linspace(0, along[-1], _LABELLED)}
    )


def _coordinates(rows: pd.DataFrame | pd.Series) -> tuple:
    """Return displacement and worn volume of rows, or of one, as they are drawn: mm and cm³."""
    return 1e3 * rows.peak, 1e6 * rows.worn_volume
