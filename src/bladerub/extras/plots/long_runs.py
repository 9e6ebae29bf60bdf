"""Growth, verdicts and cost of runs of hundreds of revolutions."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extras.passages.long_runs import LongRuns
from bladerub.plots.scales import greatest
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, RED, new_figure, styled

_VERDICTS = {
    "free": "#ffffff",
    "steady": "#dfe7ee",
    "saturating": BLUE,
    "divergent": ORANGE,
    "unbounded": RED,
}
_HATCHES = {"divergent": "//", "unbounded": "xx"}
_FLOOR = 1e-3
"""Lowest amplitude that is drawn, mm: below it a vibration has died out."""
_LOOKS = {True: {"color": DARK, "linewidth": 0.7}, False: {"color": GREY, "linewidth": 0.5}}


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
            axes.plot(number, 1e3 * amplitude, label=label, zorder=2 + grows, **_LOOKS[grows])
    axes.set(
        xscale="log",
        yscale="log",
        xlim=(1, number[-1]),
        ylim=(_FLOOR, 3e3 * greatest(*bounded)),
        xlabel="revolution",
        ylabel="amplitude (mm)",
        title="(a) half the range of $u_r$ in each revolution",
    )
    axes.legend()


def _draw_verdicts(axes: Axes, table: pd.DataFrame) -> None:
    counts = pd.crosstab(table.revolutions, table.verdict).reindex(columns=list(_VERDICTS), fill_value=0)
    bottom, places = np.zeros(len(counts)), np.arange(len(counts))
    for verdict, color in _VERDICTS.items():
        n = counts[verdict].to_numpy()
        bars = axes.bar(
            places, n, bottom=bottom, color=color, hatch=_HATCHES.get(verdict), label=verdict, edgecolor=GREY
        )
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
    axes.set(
        xscale="log",
        xlim=(1, number[-1]),
        ylim=(0, 1.4 * greatest(high)),
        xlabel="revolution",
        ylabel="ms per revolution until there",
        title="(c) cost",
    )
    axes.legend(loc="upper right")
