"""Worn depth around the casing in polar view."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots.polar import close, open_polar
from bladerub.plots.style import FIRST, PAGE, SECOND, new_figure, styled


@styled
def wear_polar(angle: np.ndarray, wear: Mapping[str, Mapping[str, np.ndarray]]) -> Figure:
    """Draw Fig. 19: a panel for each speed, in it a line for each of two cases, on one scale.

    Parameters
    ----------
    angle : (n_elements,) array_like
        Casing angle, rad.
    wear : mapping of str to mapping of str to (n_elements,) array_like
        Worn depth, m, by panel title and name of the case.
    """
    figure = new_figure(PAGE, (0.2 + 0.8 / len(wear)) * PAGE)
    deepest = 1e3 * max(np.nanmax(depth) for panel in wear.values() for depth in panel.values())
    for index, (title, cases) in enumerate(wear.items()):
        axes = open_polar(figure, 1, len(wear), index + 1)
        for (name, depth), look in zip(cases.items(), (FIRST, SECOND), strict=True):
            axes.plot(*close(angle, 1e3 * np.asarray(depth)), label=name, **look)
        axes.set(rorigin=-0.6 * deepest, rlim=(0, 1.06 * deepest), title=title)
        axes.yaxis.set_major_locator(MaxNLocator(nbins=max(2, 6 // len(wear))))
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(
        handles,
        labels,
        loc="outside lower center",
        ncols=2,
        title="worn depth (mm) outward from the inner circle, the unworn surface",
        title_fontsize=8,
    )
    return figure
