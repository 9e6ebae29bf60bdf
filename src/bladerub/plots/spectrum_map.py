"""Spectrum of the blade over frequency and speed, with the engine orders and C1."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import QuadMesh
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from bladerub.plots import cells, engine_orders, titles
from bladerub.plots.style import AMPLITUDE_MAP, BLUE, MISSING, PAGE, new_figure, styled
from bladerub.study.maps import CoatingMap

ORDERS = range(1, 13)
"""Engine orders that are drawn and labelled."""


@styled
def spectrum_map(coating: CoatingMap, amplitude_range: tuple[float, float], f_max: float) -> Figure:
    """Draw a spectrum map: f horizontally, f_Ω vertically, amplitude in colour.

    Parameters
    ----------
    coating : CoatingMap
        Runs of one coating at all speeds.
    amplitude_range : (float, float)
        Ends of the logarithmic colour scale, m.
    f_max : float
        Right end of the frequency axis, normalised.
    """
    figure = new_figure(PAGE, 0.62 * PAGE)
    axes = figure.add_subplot()
    mesh = draw_spectrum(axes, coating, amplitude_range, f_max)
    axes.set_title(titles.coating(coating.case), pad=16)
    add_amplitude_bar(figure, axes, mesh)
    return figure


def draw_spectrum(
    axes: Axes, coating: CoatingMap, amplitude_range: tuple[float, float], f_max: float
) -> QuadMesh:
    """Draw the map, the engine orders and C1 into `axes`; parameters as in `spectrum_map`."""
    speed_edges, rows = cells.with_holes(coating.f_omega, 1e3 * coating.spectrum_amplitude)
    order_edges = np.maximum(cells.edges(coating.spectrum_order), 0)
    frequency_edges = np.outer(speed_edges, order_edges)
    low, high = amplitude_range
    mesh = axes.pcolormesh(
        frequency_edges,
        np.broadcast_to(speed_edges[:, None], frequency_edges.shape),
        np.ma.masked_invalid(rows),
        cmap=AMPLITUDE_MAP,
        norm=LogNorm(1e3 * low, 1e3 * high),
        rasterized=True,
    )
    speed_max = float(speed_edges[-1])
    engine_orders.over_frequency(axes, ORDERS, f_max, speed_max)
    axes.plot(
        coating.C1,
        coating.f_omega,
        color=BLUE,
        linestyle=(0, (5, 2)),
        linewidth=1.4,
        label="$C_1$",
        zorder=3,
    )
    axes.set(
        facecolor=MISSING,
        xlim=(0, f_max),
        ylim=(0, speed_max),
        xlabel=r"frequency $f\,/\,f_1(0)$",
        ylabel=r"rotational frequency $f_\Omega\,/\,f_1(0)$",
    )
    axes.legend(loc="lower right", title="grey: not computed", title_fontsize=7)
    return mesh


def add_amplitude_bar(figure: Figure, axes: Axes, mesh: QuadMesh, **place) -> None:
    """Add the colour bar of `draw_spectrum` beside `axes`."""
    label = "amplitude of node 1, radial (mm, log scale)"
    figure.colorbar(mesh, ax=axes, label=label, extend="both", pad=0.015, **place)
