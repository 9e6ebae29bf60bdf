"""Amplitude on the way through the speeds, up and down, over that at constant speed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extensions.sweep_grid import DIRECTIONS
from bladerub.extensions.sweeps import Passage
from bladerub.plots import titles
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, RED, new_figure, styled
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap

_LOOKS = (
    {"color": DARK, "linestyle": "-", "linewidth": 1.3},
    {"color": BLUE, "linestyle": "--", "linewidth": 1.1},
    {"color": ORANGE, "linestyle": "-.", "linewidth": 1.0},
    {"color": RED, "linestyle": ":", "linewidth": 1.2},
)
_ARROWS = {"up": "speed rises →", "down": "← speed falls"}


@styled
def sweeps(passages: Sequence[Passage], maps: Mapping[CoatingCase, CoatingMap]) -> Figure:
    """Draw half the range of the displacement in each revolution over the speed, a row for each coating.

    Parameters
    ----------
    passages : sequence of Passage
        Of at most four rates.
    maps : mapping of CoatingCase to CoatingMap
        The same coatings at constant speed.
    """
    rates = sorted({passage.rate for passage in passages})
    looks = {rate: _LOOKS[index % len(_LOOKS)] for index, rate in enumerate(rates)}
    figure = new_figure(PAGE, 0.2 * PAGE + 0.24 * PAGE * len(maps))
    panels = figure.subplots(len(maps), 2, sharex=True, sharey="row", squeeze=False)
    for row, (case, constant) in zip(panels, maps.items(), strict=True):
        for axes, direction in zip(row, DIRECTIONS, strict=True):
            axes.plot(
                constant.f_omega,
                1e3 * constant.revolution_amplitude[:, -1],
                color=GREY,
                marker="o",
                markersize=1.8,
                linestyle="none",
                label="constant speed, last revolution",
            )
            for passage in passages:
                if (passage.case, passage.direction) == (case, direction):
                    _draw(axes, passage, looks[passage.rate])
            axes.grid(axis="y")
        row[0].set_title(titles.coating(case))
        row[0].set_ylabel("amplitude (mm)")
        _fit(row[0], case, passages, constant)
    for axes, direction in zip(panels[0], DIRECTIONS, strict=True):
        axes.annotate(
            _ARROWS[direction], (0.02, 0.97), xycoords="axes fraction", va="top", color=GREY, fontsize=9.5
        )
    speeds = np.concatenate([passage.speed for passage in passages])
    panels[0, 0].set_xlim(speeds.min(), speeds.max())
    for axes in panels[-1]:
        axes.set_xlabel(r"rotational frequency $f_\Omega$ (normalised)")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _draw(axes: Axes, passage: Passage, look: dict) -> None:
    amplitude = 1e3 * passage.revolution_amplitude
    axes.plot(passage.speed, amplitude, label=f"rate {passage.rate:g} a second", **look)
    if passage.status == "unbounded":
        last = np.flatnonzero(np.isfinite(amplitude))[-1]
        axes.plot(passage.speed[last], amplitude[last], color=look["color"], marker="x", label="_end")


def _fit(axes: Axes, case: CoatingCase, passages: Sequence[Passage], constant: CoatingMap) -> None:
    """Leave the last revolutions of an unbounded run out of the picture, and keep all others."""
    bounded = [constant.revolution_amplitude[constant.status == "completed", -1]]
    for passage in passages:
        if passage.case == case:
            begun = passage.revolution_amplitude[np.isfinite(passage.revolution_amplitude)]
            bounded.append(begun[:-2] if passage.status == "unbounded" else begun)
    axes.set_ylim(0, 1.08e3 * np.nanmax(np.concatenate(bounded)))
