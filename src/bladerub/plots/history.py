"""Displacement over the whole run, one run above the other, and the growth of both."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots import titles
from bladerub.plots.scales import UNKNOWN, Scales, greatest
from bladerub.plots.style import FIRST, PAGE, SECOND, new_figure, styled
from bladerub.study.store import read_run

_DRAWN = ("revolution", "radial_displacement")


@styled
def history(paths: Iterable[str | Path], scales: Scales = UNKNOWN) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 17 and 18 from the files of two runs that differ in theta.

    The table is what is drawn: ``theta``, ``revolution`` and ``radial_displacement`` of node 1, m, which is
    NaN after an early end.
    """
    runs = {run.attributes["theta"]: run for run in map(read_run, paths)}
    table = pd.concat(
        pd.DataFrame({"theta": theta} | {name: run.data[name] for name in _DRAWN})
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
