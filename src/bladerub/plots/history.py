"""Displacement over the whole run, one run above the other, and the growth of both."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots import titles
from bladerub.plots.style import FIRST, PAGE, SECOND, new_figure, styled
from bladerub.study.store import read_run

_DRAWN = ("revolution", "radial_displacement")


def history_of_runs(paths: Iterable[str | Path]) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 17 and 18 from the files of two runs that differ in theta.

    Returns the table of what is drawn (``theta``, ``revolution``, ``radial_displacement`` of node 1, m) and
    `history`.
    """
    runs = {run.attributes["theta"]: run for run in map(read_run, paths)}
    displacement = {titles.angle(theta): run.data["radial_displacement"] for theta, run in runs.items()}
    amplitude = {titles.angle(theta): run.data["revolution_amplitude"] for theta, run in runs.items()}
    first = next(iter(runs.values()))
    about = first.attributes
    title = f"{titles.moduli(about['casing'], about['E'], about['K'])}, {titles.speed(about['f_omega'])}"
    table = pd.concat(
        pd.DataFrame({"theta": theta} | {name: run.data[name] for name in _DRAWN})
        for theta, run in runs.items()
    )
    return table, history(first.data["revolution"], displacement, amplitude, title)


@styled
def history(
    revolution: np.ndarray,
    displacement: Mapping[str, np.ndarray],
    amplitude: Mapping[str, np.ndarray],
    title: str,
) -> Figure:
    """Draw the radial displacement of node 1 in two runs, m, by their names; NaN after an early end.

    `revolution` is the time, `amplitude` half the range of the displacement in each revolution, m.
    """
    figure = new_figure(PAGE, 0.76 * PAGE)
    figure.suptitle(title, fontsize=9.5, x=0.01, ha="left")
    *above, below = figure.subplots(3, 1, sharex=True, height_ratios=[1.3, 1.3, 1])
    limit = 1.08e3 * max(np.nanmax(np.abs(u)) for u in displacement.values())
    panels = zip("ab", above, displacement.items(), (FIRST, SECOND), strict=True)
    for letter, axes, (name, u), look in panels:
        axes.plot(revolution, 1e3 * np.asarray(u), color=look["color"], linewidth=0.6)
        axes.set(ylim=(-limit, limit), ylabel="$u_r$ (mm)", title=f"({letter}) {name}")
        envelope = 1e3 * np.asarray(amplitude[name])
        below.plot(np.arange(envelope.size) + 0.5, envelope, marker="o", markersize=3, label=name, **look)
    below.set_title("(c) half the range of $u_r$ in each revolution")
    below.set(xlim=(0, envelope.size), ylim=(0, limit), xlabel="revolution", ylabel="amplitude (mm)")
    below.xaxis.set_major_locator(MaxNLocator(integer=True))
    below.grid(axis="y")
    figure.legend(*below.get_legend_handles_labels(), loc="outside lower center", ncols=2)
    return figure
