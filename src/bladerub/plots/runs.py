"""Figures of runs: displacement, spectrum, and what they wore off.

Those of single runs have a line for each run drawn.
"""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.projections.polar import PolarAxes
from matplotlib.ticker import MaxNLocator

from bladerub.plots import style, titles
from bladerub.plots.polar import closed, prepare_polar
from bladerub.plots.scales import UNKNOWN, Scales, greatest
from bladerub.plots.style import COLUMN, FIRST, PAGE, SECOND, new_figure, on_axes, styled
from bladerub.study.store import read_run

_LOOKS = (
    FIRST,
    SECOND,
    {"color": style.BLUE, "linestyle": "-."},
    {"color": style.RED, "linestyle": ":"},
    {"color": style.VIOLET, "linestyle": "-"},
    {"color": style.GREY, "linestyle": "--"},
)


@styled
def histories(paths: Iterable[str | Path], scales: Scales = UNKNOWN) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 17 and 18 from the files of two runs that differ in theta.

    The table is what is drawn: ``theta``, ``revolution`` and ``radial_displacement`` of node 1, m, or NaN.
    """
    runs = {run.attributes["theta"]: run for run in map(read_run, paths)}
    drawn = ("revolution", "radial_displacement")
    table = pd.concat(
        pd.DataFrame({"theta": theta} | {name: run.data[name] for name in drawn})
        for theta, run in runs.items()
    )
    figure = new_figure(PAGE, 0.76 * PAGE)
    *above, below = figure.subplots(3, 1, sharex=True, height_ratios=[1.3, 1.3, 1])
    limit = 1.08e3 * greatest(table.radial_displacement.abs())
    panels = zip("ab", above, runs.items(), (FIRST, SECOND), strict=True)
    for letter, axes, (theta, run), look in panels:
        name, about, u = titles.angle(theta), run.attributes, 1e3 * run.data["radial_displacement"]
        axes.plot(run.data["revolution"], u, color=look["color"], linewidth=0.6)
        axes.set(ylim=(-limit, limit), ylabel="$u_r$ (mm)", title=f"({letter}) {name}")
        envelope = 1e3 * run.data["revolution_amplitude"]
        below.plot(np.arange(envelope.size) + 0.5, envelope, marker="o", markersize=3, label=name, **look)
    coating = titles.moduli(about["casing"], about["E"], about["K"], scales.modulus_unit)
    title = f"{coating}, {titles.speed(about['f_omega'], scales.f1_hz)}"
    figure.suptitle(title, fontsize=9.5, x=0.01, ha="left")
    below.set_title("(c) half the range of $u_r$ in each revolution")
    below.set(xlim=(0, envelope.size), ylim=(0, limit), xlabel="revolution", ylabel="amplitude (mm)")
    below.xaxis.set_major_locator(MaxNLocator(integer=True))
    below.grid(axis="y")
    figure.legend(*below.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return table, figure


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
    """Draw the worn depth (n,), m, over the casing angle (n,), rad: outward if polar, else in degrees."""
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
