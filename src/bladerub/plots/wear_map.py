"""Wear around the casing over the speed, each vertical line one simulation."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots import bins, titles
from bladerub.plots.scales import LARGE, UNKNOWN, Scales
from bladerub.plots.style import DARK, MISSING, PAGE, RED, WEAR_MAP, new_figure, on_axes
from bladerub.study.maps import CoatingMap

_COMPLETED = {"marker": "o", "markersize": 2.5, "color": DARK, "label": "completed"}
_LARGE = {"marker": "o", "markersize": 6, "fillstyle": "none", "color": RED, "label": LARGE}
_ENDED_EARLY = {"marker": "x", "markersize": 4, "color": RED, "label": "ended early"}


def _draw_wear(axes: Axes, coating: CoatingMap, scales: Scales) -> None:
    speed_edges, rows = bins.with_gaps(coating.f_omega, 1e3 * coating.wear)
    angle_edges, look = np.degrees(bins.edges(coating.angle)), {"cmap": WEAR_MAP, "vmin": 0}
    mesh = axes.pcolormesh(speed_edges, angle_edges, np.ma.masked_invalid(rows.T), **look, rasterized=True)
    axes.figure.colorbar(mesh, ax=axes, label="worn depth, mean of the nodes (mm)", pad=0.015)
    start = speed_edges[0] if scales.f1_hz else 0.0
    axes.set(facecolor=MISSING, ylim=(0, 360), yticks=range(0, 361, 60), ylabel="casing angle (°)")
    axes.set(xlim=(start, speed_edges[-1]))
    axes.set_title(titles.coating(coating.case, scales.modulus_unit), loc="left")
    if start < speed_edges[0] or not np.isfinite(rows).all():
        axes.set_title("grey: not computed", loc="right", fontsize=7)
    scales.draw_nominal_speed(axes.axvline)


@on_axes
def wear_map(coating: CoatingMap, scales: Scales = UNKNOWN, ax: Axes | None = None) -> Figure:
    """Draw Fig. 6: worn depth over speed and casing angle, below it the number of worn lobes.

    Runs that exceeded the displacement limit are crossed below: their wear is that of their early end. Those
    with a displacement beyond small ones are ringed. Axes that are given hold the upper diagram.
    """
    upper = lower = ax
    if ax is None:
        figure = new_figure(PAGE, 0.68 * PAGE)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[4, 1])
        _draw_lobes(lower, coating, scales)
        handles, labels = lower.get_legend_handles_labels()
        if len(handles) > 1:
            figure.legend(handles, labels, loc="outside lower center", ncols=4, handletextpad=0.4)
    _draw_wear(upper, coating, scales)
    lower.set_xlabel(r"rotational frequency $f_\Omega\,/\,f_1(0)$")
    scales.add_speeds(lower, "x")
    return upper.figure


def _draw_lobes(axes: Axes, coating: CoatingMap, scales: Scales) -> None:
    completed = coating.status == "completed"
    large = completed & scales.is_large(coating)
    for runs, look in ((completed, _COMPLETED), (~completed, _ENDED_EARLY), (large, _LARGE)):
        if runs.any():
            axes.plot(coating.f_omega[runs], coating.lobes[runs], linestyle="none", **look)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=5))
    axes.grid(axis="y")
    axes.set(ylim=(0, 1.2 * max(1, coating.lobes.max())), ylabel="worn lobes")
    scales.draw_nominal_speed(axes.axvline)
