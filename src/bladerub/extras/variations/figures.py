"""Shares of a design in which claims hold and what decides; targets, and what waves leave of the ranges."""

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extras.variations.plan import Plan
from bladerub.extras.variations.robustness import DECIDES, VERDICT
from bladerub.extras.variations.settings import Factor
from bladerub.extras.variations.targets import AT_LEAST, AT_MOST, TARGETS
from bladerub.extras.variations.waves import CUTOFF
from bladerub.plots import style

SHARES = {"yes": style.DARK, "partly": style.ORANGE, "no": style.MISSING}
"""Dark, middle and light, so that they can be distinguished in grey print."""

_BEYOND = 8.0  # standard deviations from the paper's value at which the axis ends
_PLAUSIBLE = "#e3f0dc"
_BINS = 12
_COLUMNS = 5


@style.styled
def robustness(table: pd.DataFrame, indices: pd.DataFrame) -> Figure:
    """Draw a row for each claim: the shares of the design on the left, the factors on the right."""
    figure = style.new_figure(style.PAGE, 1.6 + 0.155 * len(table))
    shares, factors = figure.subplots(1, 2, sharey=True, width_ratios=(1, 1.5))
    rows, start = np.arange(len(table)), np.zeros(len(table))
    for word, colour in SHARES.items():
        share = 100 * table[f"{word}_share"].to_numpy()
        shares.barh(rows, share, left=start, height=0.72, label=word, color=colour)
        start += share
    shares.set_yticks(rows, table.id)
    shares.set(xlim=(0, 100), ylim=(len(table) - 0.4, -0.6), xlabel="share of the design (%)")
    shares.tick_params(axis="y", length=0)
    shares.spines[:].set_visible(False)
    image = _draw_factors(factors, table, indices)
    bar = figure.colorbar(image, ax=factors, shrink=0.35, anchor=(0, 1), label="total index of the verdict")
    bar.outline.set_visible(False)
    figure.legend(loc="outside lower left", ncols=len(SHARES))
    return figure


def _draw_factors(axes, table: pd.DataFrame, indices: pd.DataFrame):
    of_verdict = indices[indices.output == VERDICT]
    factors = list(dict.fromkeys(indices.factor))
    total = of_verdict.pivot(index="id", columns="factor", values="total")
    total = total.reindex(index=table.id, columns=factors).astype(float)
    scale = np.fmax(DECIDES, total.max(axis=None))  # often small, because there are many factors
    columns, rows = np.arange(len(factors) + 1) - 0.5, np.arange(len(table) + 1) - 0.5
    image = axes.pcolormesh(columns, rows, total, cmap=style.WEAR_MAP, vmin=0, vmax=scale)
    for row, column in np.argwhere(total.to_numpy() >= DECIDES):
        value = total.iat[row, column]
        colour = "white" if value > scale / 2 else style.DARK
        axes.text(column, row, f"{value:.1f}", ha="center", va="center", fontsize=6, color=colour)
    for row, predicted in enumerate(table.predicted):
        axes.axhline(row - 0.5, color="white", linewidth=0.6)
        if np.isfinite(predicted):
            axes.text(len(factors) - 0.3, row, f"{predicted:.2f}", va="center", fontsize=6)
    axes.set_facecolor(style.MISSING)
    axes.text(len(factors) - 0.3, len(table) - 0.2, "predicted", rotation=90, va="top", fontsize=8)
    axes.set_xticks(range(len(factors)), factors, rotation=90)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    return image


@style.styled
def identification(plan: Plan, measured: pd.DataFrame, points: pd.DataFrame, best: pd.DataFrame) -> Figure:
    """Draw the targets of all sets, the study's own first, and below them what is left of each range."""
    rows, heights = -(-len(plan.factors) // _COLUMNS), 0.14 * measured.shape[1] + 0.8
    figure = style.new_figure(style.PAGE, heights + 1.0 * rows)
    above, below = figure.subfigures(2, 1, height_ratios=(heights, 1.0 * rows))
    _draw_targets(above.subplots(), plan, measured)
    panels = below.subplots(rows, _COLUMNS, squeeze=False).ravel()
    themselves = best.xs(0, level="neighbour")
    for axes, (name, factor) in zip(panels, plan.factors.items(), strict=False):
        _draw_range(axes, factor, points[name], themselves[name])
    for axes in panels[len(plan.factors) :]:
        axes.set_axis_off()
    return figure


def _draw_targets(axes: Axes, plan: Plan, measured: pd.DataFrame) -> None:
    waves = np.repeat(np.arange(len(plan.waves)), [plan.size(wave + 1) for wave in range(len(plan.waves))])
    colours = colormaps["Blues"](np.linspace(0.35, 0.95, len(plan.waves)))[waves[measured.index]]
    spread = np.random.default_rng(0).uniform(-0.3, 0.3, len(measured))
    for row, (name, values) in enumerate(measured.items()):
        target = TARGETS[name]
        distance = ((values - target.value) / target.error).clip(-_BEYOND, _BEYOND)
        low = -_BEYOND if target.relation == AT_MOST else -CUTOFF
        high = _BEYOND if target.relation == AT_LEAST else CUTOFF
        axes.barh(row, high - low, left=low, height=0.86, color=_PLAUSIBLE, zorder=0)
        axes.scatter(distance, row + spread, s=1.8, color=colours)
        axes.plot(distance.iloc[0], row, "D", color=style.ORANGE, markersize=4)
    labels = [f"{TARGETS[name].claim}  {name.replace('_', ' ')}" for name in measured]
    axes.set_yticks(range(len(labels)), labels, fontsize=7)
    axes.set(xlim=(-_BEYOND - 0.3, _BEYOND + 0.3), ylim=(len(labels) - 0.4, -0.6))
    axes.axvline(0, color=style.RED, linewidth=0.8)
    axes.set_xlabel("distance from the paper (standard deviations of reading and of another blade)")
    axes.tick_params(axis="y", length=0)


def _draw_range(axes: Axes, factor: Factor, points: pd.Series, candidates: pd.Series) -> None:
    """Draw the density of what is left of one range, the best sets, and the study's own value."""
    axes.hist(points, bins=_BINS, range=(0, 1), density=True, color=style.MISSING, edgecolor="white")
    axes.axhline(1.0, color=style.GREY, linewidth=0.6, linestyle=":")
    axes.plot(candidates.iloc[1:], np.full(len(candidates) - 1, 0.15), "|", color=style.BLUE, markersize=8)
    axes.axvline(candidates.iloc[0], color=style.ORANGE, linewidth=1.2)
    unit = "" if factor.unit == "1" else f" ({factor.unit})"
    axes.set_title(f"{points.name.replace('_', ' ')}{unit}", fontsize=8)
    axes.set_xticks([0, 1], [f"{factor.first_value(end):.3g}" for end in (0.0, 1.0)])
    axes.set(yticks=[], xlim=(0, 1))
