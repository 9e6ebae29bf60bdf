"""Speeds of the peaks against the modulus of the contact: contact stiffening is one curve."""

from itertools import cycle

import pandas as pd
from matplotlib.figure import Figure

from bladerub.extensions.chart.stiffening import is_stiffened
from bladerub.plots import titles
from bladerub.plots.style import DARK, GREY, ORANGE, PAGE, new_figure, styled

_LOOKS = ({"marker": "o", "color": DARK, "ms": 2.4}, {"marker": "^", "color": ORANGE, "ms": 3.2})


@styled
def chart_stiffening(peaks: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """Draw f_k of all points of ``chart_explanation.csv`` over E_T, a panel for each order.

    `summary` is from `bladerub.extensions.chart.stiffening.table`.
    """
    orders = sorted(peaks.order.unique())
    figure = new_figure(PAGE, 0.52 * PAGE)
    row = figure.subplots(1, len(orders), squeeze=False)[0]
    correlation = summary.set_index(["order", "theta"]).rank_correlation_E_T
    for index, (axes, order) in enumerate(zip(row, orders, strict=True)):
        of_order = peaks[peaks.order == order]
        for (theta, points), look in zip(of_order.groupby("theta"), cycle(_LOOKS), strict=False):
            kept, others = points[is_stiffened(points)], points[~is_stiffened(points)]
            marks = {"ls": "none", "mew": 0.5, **look}
            label = rf"$\theta$ = {theta:g} rad, rank correlation {correlation[order, theta]:.2f}"
            axes.plot(kept.E_T, kept.f_peak, **marks, mec="none", label=label)
            axes.plot(others.E_T, others.f_peak, **marks | {"mfc": "none", "color": GREY})
        axes.axhline(of_order.f_crossing.mean(), color=GREY, lw=0.9, ls="--", label="crossing with $C_1$")
        axes.set(xscale="log", xlabel="contact modulus $E_T = EK/(E+K)$", ylabel=f"$f_{order}$")
        axes.set_title(titles.panel(index, f"eo({order})"), pad=38)
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1), fontsize=7, borderaxespad=0.1)
        axes.grid(True)
    return figure
