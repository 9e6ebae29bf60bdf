"""Figures of one run: its displacement, its spectrum, and what it wore off."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots.polar import closed, open_polar
from bladerub.plots.scales import greatest
from bladerub.plots.style import COLUMN, FIRST, PAGE, SECOND, new_figure, styled


@styled
def history(revolution: np.ndarray, displacement: np.ndarray, amplitude: np.ndarray, title: str) -> Figure:
    """Draw the radial displacement of node 1 over the `revolution` (n,), and its amplitude in each, m."""
    figure = new_figure(PAGE, 0.42 * PAGE)
    axes = figure.add_subplot()
    axes.plot(revolution, 1e3 * displacement, color=FIRST["color"], linewidth=0.6, label="$u_r$")
    middle = np.arange(amplitude.size) + 0.5
    axes.plot(middle, 1e3 * amplitude, marker="o", markersize=3, label="amplitude: half the range", **SECOND)
    axes.set(xlim=(0, amplitude.size), xlabel="revolution", ylabel="radial displacement (mm)", title=title)
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(axis="y")
    axes.legend(loc="upper left", ncols=2)
    return figure


@styled
def spectrum(order: np.ndarray, amplitude: np.ndarray, title: str) -> Figure:
    """Draw the amplitude (m) of the radial displacement of node 1 over the engine order, both (m,)."""
    figure = new_figure(PAGE, 0.42 * PAGE)
    axes = figure.add_subplot()
    axes.plot(order, 1e3 * np.asarray(amplitude), color=FIRST["color"], linewidth=1.2)
    axes.set(xlim=(0, np.max(order)), ylim=(0, 1.05e3 * greatest(amplitude)), title=title)
    axes.set(xlabel="engine order", ylabel="amplitude of $u_r$ (mm)")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True, nbins=14))
    axes.grid()
    return figure


@styled
def wear(angle: np.ndarray, depth: np.ndarray, title: str) -> Figure:
    """Draw the worn depth (n,), m, over the casing angle (n,), rad, outward from the unworn surface."""
    figure = new_figure(COLUMN, 1.15 * COLUMN)
    deepest = 1e3 * greatest(depth)
    axes = open_polar(figure, 1, 1, 1)
    axes.plot(*closed(angle, 1e3 * np.asarray(depth)), **FIRST)
    axes.set(rorigin=-0.6 * deepest, rlim=(0, 1.06 * deepest))
    axes.set_title(title, fontsize=8, pad=14)
    axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
    figure.supxlabel("worn depth (mm), mean of the 8 nodes,\noutward from the unworn surface", fontsize=8)
    return figure
