"""Figures of single runs: displacement, spectrum, and what they wore off; a line for each run drawn."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from bladerub.plots.polar import closed, prepare_polar
from bladerub.plots.scales import greatest
from bladerub.plots.style import BLUE, COLUMN, FIRST, GREY, PAGE, RED, SECOND, VIOLET, new_figure, on_axes

_LOOKS = (
    FIRST,
    SECOND,
    {"color": BLUE, "linestyle": "-."},
    {"color": RED, "linestyle": ":"},
    {"color": VIOLET, "linestyle": "-"},
    {"color": GREY, "linestyle": "--"},
)


@on_axes
def history(
    revolution: np.ndarray, displacement: np.ndarray, amplitude: np.ndarray, name: str, ax: Axes | None = None
) -> Figure:
    """Draw the radial displacement of node 1 over the `revolution` (n,), and its amplitude in each, m."""
    axes = ax or new_figure(PAGE, 0.42 * PAGE).add_subplot()
    line = _add(axes, revolution, 1e3 * displacement, name, linewidth=0.6, alpha=0.5)
    middle, marks = np.arange(amplitude.size) + 0.5, {"marker": "o", "markersize": 3, "label": "_amplitude"}
    axes.plot(middle, 1e3 * amplitude, color=line.get_color(), linestyle=line.get_linestyle(), **marks)
    axes.margins(x=0)
    axes.set(xlabel="revolution; dots: half the range in each", ylabel="radial displacement (mm)")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    axes.grid(axis="y")
    return axes.figure


@on_axes
def spectrum(order: np.ndarray, amplitude: np.ndarray, name: str, ax: Axes | None = None) -> Figure:
    """Draw the amplitude (m) of the radial displacement of node 1 over the engine order, both (m,)."""
    axes = ax or new_figure(PAGE, 0.42 * PAGE).add_subplot()
    _add(axes, order, 1e3 * np.asarray(amplitude), name)
    axes.margins(x=0)
    axes.set(ylim=(0, 1.05 * _top(axes)), xlabel="engine order", ylabel="amplitude of $u_r$ (mm)")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True, nbins=14))
    axes.grid()
    return axes.figure


@on_axes
def wear(angle: np.ndarray, depth: np.ndarray, name: str, ax: Axes | None = None) -> Figure:
    """Draw the worn depth (n,), m, over the casing angle (n,), rad.

    It is drawn outward from the unworn surface in polar axes, over degrees in others.
    """
    axes = ax or new_figure(COLUMN, 1.15 * COLUMN).add_subplot(projection="polar")
    millimetres = 1e3 * np.asarray(depth)
    if isinstance(axes, PolarAxes):
        prepare_polar(axes)
        _add(axes, *closed(angle, millimetres), name)
        axes.set(rorigin=-0.6 * _top(axes), rlim=(0, 1.06 * _top(axes)))
        axes.set_xlabel("worn depth (mm), mean of the nodes,\noutward from the unworn surface", fontsize=8)
        if axes.get_legend():
            axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.22))
    else:
        _add(axes, np.degrees(angle), millimetres, name)
        axes.set(xlim=(0, 360), xticks=range(0, 361, 60), ylim=(0, 1.06 * _top(axes)))
        axes.set(xlabel="casing angle (°)", ylabel="worn depth, mean of the nodes (mm)")
    axes.yaxis.set_major_locator(MaxNLocator(nbins=4))
    return axes.figure


def _add(axes: Axes, x: np.ndarray, y: np.ndarray, name: str, **look: float) -> Line2D:
    """Draw a line in the look that comes next; its name is the title, those of several are the legend."""
    number = len(_named(axes))
    (line,) = axes.plot(x, y, label=name, **_LOOKS[number % len(_LOOKS)], **look)
    is_named = bool(axes.get_title(loc="center"))  # by who has given the axes
    axes.set_title("" if number or is_named else name, loc="left", fontsize=8)
    if number or is_named:
        axes.legend(loc="best")
    return line


def _named(axes: Axes) -> list[Line2D]:
    return [line for line in axes.lines if not str(line.get_label()).startswith("_")]


def _top(axes: Axes) -> float:
    """Find the end of the axis that shows all lines, mm."""
    return greatest(*(np.asarray(line.get_ydata(), dtype=float) for line in _named(axes)))
