"""Error of runs over the number of their time steps, by the Young modulus of the coating."""

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from bladerub.extras.verification.steps import STUDY
from bladerub.plots.style import DARK, GREY, PAGE, new_figure, styled

_QUANTILES = {"median": 0.5, "nine runs in ten": 0.9}


@styled
def steps(table: pd.DataFrame) -> Figure:
    """Draw the error over the steps of a revolution, from `bladerub.extras.verification.steps.table`.

    A line joins the tolerances of one Young modulus; runs that are chaotic are left out.
    """
    calm = table[~table.sensitive.astype(bool)]
    figure = new_figure(PAGE, 0.5 * PAGE)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    moduli = np.sort(calm.E.unique())
    colours = dict(
        zip(moduli, matplotlib.colormaps["viridis"](np.linspace(0, 0.9, moduli.size)), strict=True)
    )
    colours |= {E: DARK for E in moduli if np.isinf(E)}
    for axes, (name, quantile) in zip(panels, _QUANTILES.items(), strict=True):
        for E, runs in calm.groupby("E"):
            _draw(axes, runs, quantile, colours[E], "rigid" if np.isinf(E) else f"E = {E:g}")
        axes.axhline(STUDY, color=GREY, linewidth=0.8, linestyle=":")
        axes.set(xscale="log", yscale="log", xlabel="time steps in a revolution (thousand)", title=name)
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(lambda steps, _: f"{steps / 1e3:g}")
        axes.xaxis.set_minor_locator(NullLocator())
        axes.grid()
    panels[0].set_ylabel("error")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right center")
    return figure


def _draw(axes: Axes, runs: pd.DataFrame, quantile: float, colour: object, label: str) -> None:
    """Join the tolerances of one modulus; a full mark is the study's, a cross is one step for all."""
    by_tolerance = runs.groupby("tolerance", dropna=False)
    cost, error = by_tolerance.steps_per_revolution.median(), by_tolerance.error.quantile(quantile)
    rule, uniform = cost.index.notna(), cost.index.isna()
    axes.plot(cost[rule], error[rule], color=colour, marker="o", markersize=3, mfc="white", label=label)
    axes.plot(cost[STUDY], error[STUDY], color=colour, marker="o", markersize=5, label=f"_{label}")
    look = {"color": colour, "marker": "x", "linestyle": "none", "markersize": 5}
    axes.plot(cost[uniform], error[uniform], **look, label=f"_{label}")
