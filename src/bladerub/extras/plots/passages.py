"""Speed sweeps beside constant speed, and what becomes of long runs."""

from collections.abc import Mapping, Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extras.passages.long_runs import LongRuns
from bladerub.extras.passages.sweep_grid import DIRECTIONS
from bladerub.extras.passages.sweeps import SpeedSweep
from bladerub.plots import titles
from bladerub.plots.scales import UNKNOWN, Scales, greatest
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, RED, new_figure, styled
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap

_RATES = (
    {"color": DARK, "linestyle": "-", "linewidth": 1.3},
    {"color": BLUE, "linestyle": "--", "linewidth": 1.1},
    {"color": ORANGE, "linestyle": "-.", "linewidth": 1.0},
    {"color": RED, "linestyle": ":", "linewidth": 1.2},
)
_CONSTANT = {"color": GREY, "marker": "o", "markersize": 1.8, "linestyle": "none"}
_ARROWS = {"up": "speed rises →", "down": "← speed falls"}


@styled
def sweeps(
    swept: Sequence[SpeedSweep], maps: Mapping[CoatingCase, CoatingMap], scales: Scales = UNKNOWN
) -> Figure:
    """Draw half the range in each revolution over the speed, a row for each coating, beside its map."""
    rates = sorted({sweep.rate for sweep in swept})
    looks = {rate: _RATES[index % len(_RATES)] for index, rate in enumerate(rates)}
    figure = new_figure(PAGE, 0.2 * PAGE + 0.24 * PAGE * len(maps))
    panels = figure.subplots(len(maps), 2, sharex=True, sharey="row", squeeze=False)
    for row, (case, constant) in zip(panels, maps.items(), strict=True):
        for axes, direction in zip(row, DIRECTIONS, strict=True):
            amplitude = 1e3 * constant.revolution_amplitude[:, -1]
            axes.plot(constant.f_omega, amplitude, label="constant speed, last revolution", **_CONSTANT)
            for sweep in swept:
                if (sweep.case, sweep.direction) == (case, direction):
                    _draw_sweep(axes, sweep, looks[sweep.rate])
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
        scales.add_speeds(axes, "x")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _draw_sweep(axes: Axes, sweep: SpeedSweep, look: dict) -> None:
    amplitude = 1e3 * sweep.revolution_amplitude
    axes.plot(sweep.speed, amplitude, label=f"rate {sweep.rate:g} a second", **look)
    if sweep.status == "unbounded" and np.isfinite(amplitude).any():
        last = np.flatnonzero(np.isfinite(amplitude))[-1]
        axes.plot(sweep.speed[last], amplitude[last], color=look["color"], marker="x", label="_end")


def _limit(axes: Axes, case: CoatingCase, swept: Sequence[SpeedSweep], constant: CoatingMap) -> None:
    """Fit the axis to all revolutions but the last whole one of an unbounded run."""
    bounded = [constant.revolution_amplitude[constant.status == "completed", -1]]
    for sweep in swept:
        if sweep.case == case:
            amplitude = sweep.revolution_amplitude[np.isfinite(sweep.revolution_amplitude)]
            bounded.append(amplitude[:-1] if sweep.status == "unbounded" else amplitude)
    axes.set_ylim(0, 1.08e3 * greatest(*bounded))


_VERDICTS = {
    "free": "#ffffff",
    "steady": "#dfe7ee",
    "saturating": BLUE,
    "divergent": ORANGE,
    "unbounded": RED,
}
_HATCHES = {"divergent": "//", "unbounded": "xx"}
_FLOOR = 1e-3  # lowest amplitude that is drawn, mm: below it a vibration has died out
_GROWTH = {True: {"color": DARK, "linewidth": 0.7}, False: {"color": GREY, "linewidth": 0.5}}


@styled
def long_runs(coatings: Sequence[LongRuns], table: pd.DataFrame) -> Figure:
    """Draw growth, verdicts and cost; `table` is from `bladerub.extras.passages.long_runs.table`."""
    figure = new_figure(PAGE, 0.72 * PAGE)
    panels = figure.subplot_mosaic([["growth", "growth"], ["verdicts", "cost"]], height_ratios=[1.2, 1])
    _draw_growth(panels["growth"], coatings)
    _draw_verdicts(panels["verdicts"], table)
    _draw_cost(panels["cost"], coatings)
    return figure


def _draw_growth(axes: Axes, coatings: Sequence[LongRuns]) -> None:
    bounded = [long.revolution_amplitude[long.status == "completed"] for long in coatings]
    labels = {True: "grew to the end of the study's longest run", False: "at a peak"}
    for long in coatings:
        for why, amplitude in zip(long.why, long.revolution_amplitude, strict=True):
            grows = why == "grows"
            number, label = np.arange(1, amplitude.size + 1), labels.pop(grows, "_more")
            axes.plot(number, 1e3 * amplitude, label=label, zorder=2 + grows, **_GROWTH[grows])
    limits = {"xlim": (1, number[-1]), "ylim": (_FLOOR, 3e3 * greatest(*bounded))}
    axes.set(xscale="log", yscale="log", xlabel="revolution", ylabel="amplitude (mm)", **limits)
    axes.set_title("(a) half the range of $u_r$ in each revolution")
    axes.legend()


def _draw_verdicts(axes: Axes, table: pd.DataFrame) -> None:
    counts = pd.crosstab(table.revolutions, table.verdict).reindex(columns=list(_VERDICTS), fill_value=0)
    bottom, places = np.zeros(len(counts)), np.arange(len(counts))
    for verdict, color in _VERDICTS.items():
        n, look = counts[verdict].to_numpy(), {"color": color, "hatch": _HATCHES.get(verdict)}
        bars = axes.bar(places, n, bottom=bottom, label=verdict, edgecolor=GREY, **look)
        axes.bar_label(bars, [f"{count}" if count else "" for count in n], label_type="center", fontsize=7)
        bottom += n
    axes.set_xticks(places, [f"{revolutions}" for revolutions in counts.index])
    axes.set(xlabel="judged after so many revolutions", ylabel="runs", title="(b) what is said of them")
    axes.set_ylim(0, 1.45 * bottom.max())
    axes.legend(ncols=3, loc="upper center", columnspacing=1.0)


def _draw_cost(axes: Axes, coatings: Sequence[LongRuns]) -> None:
    seconds = np.concatenate([long.seconds for long in coatings])
    number = np.arange(1, seconds.shape[1] + 1)
    bounded = np.isfinite(seconds).all(axis=1)
    cost = 1e3 * seconds[bounded] / number if bounded.any() else np.full((1, number.size), np.nan)
    low, middle, high = np.quantile(cost, [0.1, 0.5, 0.9], axis=0)
    axes.fill_between(number, low, high, color="#dfe7ee", label="eight runs of ten")
    axes.plot(number, middle, color=DARK, label="median of the runs that stay in bounds")
    axes.set(xscale="log", xlim=(1, number[-1]), ylim=(0, 1.4 * greatest(high)), title="(c) cost")
    axes.set(xlabel="revolution", ylabel="ms per revolution until there")
    axes.legend(loc="upper right")
