"""Wear around the casing over the speed, each vertical line one simulation."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots import cells, titles
from bladerub.plots.style import DARK, MISSING, PAGE, RED, WEAR_MAP, new_figure, styled
from bladerub.study.maps import CoatingMap


@styled
def wear_map(coating: CoatingMap) -> Figure:
    """Draw Fig. 6: worn depth over speed and casing angle, below it the number of worn lobes.

    Runs that left all bounds are crossed in the lower panel: their wear is that of the moment they ended.
    """
    speed_edges, rows = cells.with_holes(coating.f_omega, 1e3 * coating.wear)
    figure = new_figure(PAGE, 0.68 * PAGE)
    upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[4, 1])
    mesh = upper.pcolormesh(
        speed_edges,
        np.degrees(cells.edges(coating.angle)),
        np.ma.masked_invalid(rows.T),
        cmap=WEAR_MAP,
        vmin=0,
        rasterized=True,
    )
    figure.colorbar(mesh, ax=upper, label="worn depth, mean of the 8 nodes (mm)", pad=0.015)
    upper.set(facecolor=MISSING, ylim=(0, 360), yticks=range(0, 361, 60), ylabel="casing angle (°)")
    upper.set_title(titles.coating(coating.case))
    completed = coating.status == "completed"
    for runs, look in (
        (completed, {"marker": "o", "markersize": 2.5, "color": DARK, "label": "completed"}),
        (~completed, {"marker": "x", "markersize": 4, "color": RED, "label": "ended early"}),
    ):
        if runs.any():
            lower.plot(coating.f_omega[runs], coating.lobes[runs], linestyle="none", **look)
    room = 1.2
    if not completed.all():
        room = 1.7  # for the legend above the markers
        lower.legend(loc="upper left", ncols=2)
    lower.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=5))
    lower.grid(axis="y")
    lower.set(
        xlim=(0, speed_edges[-1]),
        ylim=(0, room * max(1, coating.lobes.max())),
        xlabel=r"rotational frequency $f_\Omega\,/\,f_1(0)$",
        ylabel="worn lobes",
    )
    return figure
