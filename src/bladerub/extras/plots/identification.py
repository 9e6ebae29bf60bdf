"""How far the simulated sets are from the paper, and what the waves leave of the ranges."""

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extras.factors import Factor
from bladerub.extras.identification.implausibility import CUTOFF
from bladerub.extras.identification.plan import Plan
from bladerub.extras.identification.targets import AT_LEAST, AT_MOST, TARGETS
from bladerub.plots.style import BLUE, GREY, MISSING, ORANGE, PAGE, RED, new_figure, styled

_BEYOND = 8.0  # standard deviations from the paper's value at which the axis ends
_PLAUSIBLE = "#e3f0dc"
_BINS = 12
_COLUMNS = 5


@styled
def identification(
    plan: Plan, measured: pd.DataFrame, points: pd.DataFrame, candidates: pd.DataFrame
) -> Figure:
    """Draw the targets of all sets above, and what is left of the range of each factor below.

    `measured` has the targets of each set, the study's own first. `points` are points of what is left and
    `candidates` the best sets, both as fractions of the ranges.
    """
    rows, heights = -(-len(plan.factors) // _COLUMNS), 0.14 * measured.shape[1] + 0.8
    figure = new_figure(PAGE, heights + 1.0 * rows)
    above, below = figure.subfigures(2, 1, height_ratios=(heights, 1.0 * rows))
    _draw_targets(above.subplots(), plan, measured)
    panels = below.subplots(rows, _COLUMNS, squeeze=False).ravel()
    themselves = candidates.xs(0, level="neighbour")
    for axes, factor in zip(panels, plan.factors, strict=False):
        _draw_range(axes, factor, points[factor.name], themselves[factor.name])
    for axes in panels[len(plan.factors) :]:
        axes.set_axis_off()
    return figure


def _draw_targets(axes: Axes, plan: Plan, measured: pd.DataFrame) -> None:
    waves = np.repeat(np.arange(len(plan.waves)), [plan.size(wave + 1) for wave in range(len(plan.waves))])
    colours = colormaps["Blues"](np.linspace(0.35, 0.95, len(plan.waves)))[waves[measured.index]]
    spread = np.random.default_rng(0).uniform(-0.3, 0.3, len(measured))
    targets = {target.name: target for target in TARGETS}
    for row, (name, values) in enumerate(measured.items()):
        target = targets[name]
        distance = ((values - target.value) / target.error).clip(-_BEYOND, _BEYOND)
        low = -_BEYOND if target.relation == AT_MOST else -CUTOFF
        high = _BEYOND if target.relation == AT_LEAST else CUTOFF
        axes.barh(row, high - low, left=low, height=0.86, color=_PLAUSIBLE, zorder=0)
        axes.scatter(distance, row + spread, s=1.8, color=colours)
        axes.plot(distance.iloc[0], row, "D", color=ORANGE, markersize=4)
    labels = [f"{targets[name].claim}  {name.replace('_', ' ')}" for name in measured]
    axes.set_yticks(range(len(labels)), labels, fontsize=7)
    axes.set_ylim(len(labels) - 0.4, -0.6)
    axes.set_xlim(-_BEYOND - 0.3, _BEYOND + 0.3)
    axes.axvline(0, color=RED, linewidth=0.8)
    axes.set_xlabel("distance from the paper (standard deviations of reading and of another blade)")
    axes.tick_params(axis="y", length=0)


def _draw_range(axes: Axes, factor: Factor, points: pd.Series, candidates: pd.Series) -> None:
    """Draw the density of what is left of one range, the best sets, and the study's own value."""
    axes.hist(points, bins=_BINS, range=(0, 1), density=True, color=MISSING, edgecolor="white")
    axes.axhline(1.0, color=GREY, linewidth=0.6, linestyle=":")
    axes.plot(candidates.iloc[1:], np.full(len(candidates) - 1, 0.15), "|", color=BLUE, markersize=8)
    axes.axvline(candidates.iloc[0], color=ORANGE, linewidth=1.2)
    unit = "" if factor.unit == "1" else f" ({factor.unit})"
    axes.set_title(f"{factor.name.replace('_', ' ')}{unit}", fontsize=8)
    axes.set_xticks([0, 1], [f"{factor.first_value(end):.3g}" for end in (0.0, 1.0)])
    axes.set_yticks([])
    axes.set_xlim(0, 1)
