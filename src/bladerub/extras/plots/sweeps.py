"""Amplitude in speed sweeps, up and down, over that at constant speed."""

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extras.passages.sweep_grid import DIRECTIONS
from bladerub.extras.passages.sweeps import SpeedSweep
from bladerub.plots import titles
from bladerub.plots.scales import greatest
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, RED, new_figure, styled
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap

_LOOKS = (
    {"color": DARK, "linestyle": "-", "linewidth": 1.3},
    {"color": BLUE, "linestyle": "--", "linewidth": 1.1},
    {"color": ORANGE, "linestyle": "-.", "linewidth": 1.0},
    {"color": RED, "linestyle": ":", "linewidth": 1.2},
)
_CONSTANT = {"color": GREY, "marker": "o", "markersize": 1.8, "linestyle": "none"}
_CONSTANT |= {"label": "constant speed, last revolution"}
_ARROWS = {"up": "speed rises →", "down": "← speed falls"}


@styled
def sweeps(swept: Sequence[SpeedSweep], maps: Mapping[CoatingCase, CoatingMap]) -> Figure:
    """Draw half the range of the displacement in each revolution over the speed, a row for each coating.

    `maps` has the same coatings at constant speed. Up to four rates have different lines.
    """
    rates = sorted({sweep.rate for sweep in swept})
    looks = {rate: _LOOKS[index % len(_LOOKS)] for index, rate in enumerate(rates)}
    figure = new_figure(PAGE, 0.2 * PAGE + 0.24 * PAGE * len(maps))
    panels = figure.subplots(len(maps), 2, sharex=True, sharey="row", squeeze=False)
    for row, (case, constant) in zip(panels, maps.items(), strict=True):
        for axes, direction in zip(row, DIRECTIONS, strict=True):
            axes.plot(constant.f_omega, 1e3 * constant.revolution_amplitude[:, -1], **_CONSTANT)
            for sweep in swept:
                if (sweep.case, sweep.direction) == (case, direction):
                    _draw(axes, sweep, looks[sweep.rate])
            axes.grid(axis="y")
        row[0].set_title(titles.coating(case))
        row[0].set_ylabel("amplitude (mm)")
        _limit(row[0], case, swept, constant)
    place = {"xy": (0.02, 0.97), "xycoords": "axes fraction", "va": "top"}
    for axes, direction in zip(panels[0], DIRECTIONS, strict=True):
        axes.annotate(_ARROWS[direction], **place, color=GREY, fontsize=9.5)
    speeds = np.concatenate([sweep.speed for sweep in swept])
    panels[0, 0].set_xlim(speeds.min(), speeds.max())
    for axes in panels[-1]:
        axes.set_xlabel(r"rotational frequency $f_\Omega$ (normalised)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _draw(axes: Axes, sweep: SpeedSweep, look: dict) -> None:
    amplitude = 1e3 * sweep.revolution_amplitude
    axes.plot(sweep.speed, amplitude, label=f"rate {sweep.rate:g} a second", **look)
    if sweep.status == "unbounded" and np.isfinite(amplitude).any():
        last = np.flatnonzero(np.isfinite(amplitude))[-1]
        axes.plot(sweep.speed[last], amplitude[last], color=look["color"], marker="x", label="_end")


def _limit(axes: Axes, case: CoatingCase, swept: Sequence[SpeedSweep], constant: CoatingMap) -> None:
    """Fit the axis to all revolutions but the last two of an unbounded run."""
    bounded = [constant.revolution_amplitude[constant.status == "completed", -1]]
    for sweep in swept:
        if sweep.case == case:
            amplitude = sweep.revolution_amplitude[np.isfinite(sweep.revolution_amplitude)]
            bounded.append(amplitude[:-2] if sweep.status == "unbounded" else amplitude)
    axes.set_ylim(0, 1.08e3 * greatest(*bounded))
