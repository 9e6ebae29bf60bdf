"""Amplification and shares of the wear in rows of blades."""

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extensions.rotor.plan import Combination, Plan
from bladerub.extensions.rotor.summary import label
from bladerub.plots import titles
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, new_figure, styled

_PANELS = (
    ("amplification", DARK, "amplitude of the row\n(single blade = 1)"),
    ("longest_share", BLUE, "wear by the longest\n(even share = 1)"),
    ("largest_share", ORANGE, "wear by the blade that\nwears most (even = 1)"),
)


@styled
def rotor(plan: Plan, table: pd.DataFrame) -> Figure:
    """Draw medians and the interval of 90 % of the draws, a column of panels for each coating and speed.

    `table` is that of `bladerub.extensions.rotor.summary.combinations`; the shares are in parts of an even
    one.
    """
    groups: dict[tuple, list] = {}
    for combination in plan.combinations.values():
        if combination.blades > 1 or combination != combination.alone:
            groups.setdefault((combination.case, combination.f_omega), []).append(combination)
    widths = [max(len(members), 4) for members in groups.values()]
    figure = new_figure(max(PAGE, 0.35 * sum(widths) + 2.0), 8.0)
    panels = figure.subplots(3, len(groups), sharex="col", squeeze=False, width_ratios=widths)
    by_name = table.set_index([*table.columns[:9]])
    for column, ((case, f_omega), members) in zip(panels.T, groups.items(), strict=True):
        members = sorted(
            members, key=lambda of: (of.blades, of.length_scatter, of.frequency_scatter, of.coupling)
        )
        own = [
            by_name.loc[(case.casing, case.E, case.K, case.theta, f_omega, *_scatters(of))] for of in members
        ]
        for axes, (name, colour, _) in zip(column, _PANELS, strict=True):
            scale = [1 if name == "amplification" else of.blades for of in members]
            _draw(axes, name, colour, own, scale)
        column[0].set_title(f"E = {case.E:g}, K = {case.K:g}\n{titles.speed(f_omega)}", fontsize=8)
        column[-1].set_xticks(range(len(members)), [label(of) for of in members], rotation=90, fontsize=7)
    for axes, (_, _, text) in zip(panels[:, 0], _PANELS, strict=True):
        axes.set_ylabel(text)
    panels[-1, 0].set_xlabel("blades: scatter of length, of frequency", loc="left")
    return figure


def _scatters(of: Combination) -> tuple:
    return of.blades, of.length_scatter, of.frequency_scatter, of.coupling


def _draw(axes: Axes, name: str, colour: str, own: list[pd.Series], scale: list[float]) -> None:
    for at, (row, factor) in enumerate(zip(own, scale, strict=True)):
        low, middle, high = (factor * row[f"{name}_{of}"] for of in ("p05", "median", "p95"))
        axes.plot([at, at], [low, high], color=colour, linewidth=1.5)
        axes.plot(at, middle, "o", color=colour, markersize=3.5)
    axes.axhline(1.0, color=GREY, linewidth=0.6)
    axes.grid(axis="y")
    axes.set_ylim(bottom=0)
