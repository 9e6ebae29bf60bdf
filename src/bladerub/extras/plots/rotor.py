"""Amplification and shares of the wear in rows of blades, and their amplitude over the speed."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.extras.rotor.plan import Combination, Plan, described
from bladerub.extras.rotor.summary import WHAT, label
from bladerub.plots import titles
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, new_figure, styled
from bladerub.study.grid import CoatingCase

_PANELS = (
    ("amplification", DARK, "amplitude of the row\n(single blade = 1)"),
    ("longest_share", BLUE, "wear by the longest\n(even share = 1)"),
    ("largest_share", ORANGE, "wear by the blade that\nwears most (even = 1)"),
)

_GAP = 3.0  # steps of the speed over their median


@styled
def rotor(plan: Plan, table: pd.DataFrame) -> Figure:
    """Draw medians and 90 % of the draws of `extras.rotor.summary`; shares of wear are over even ones."""
    groups: dict[tuple, list] = {}
    for combination in plan.compared:
        if combination.blades > 1 or combination != combination.alone:
            groups.setdefault((combination.case, combination.f_omega), []).append(combination)
    if not groups:
        figure = new_figure(PAGE, 1.0)
        figure.text(0.5, 0.5, "single nominal blades only", ha="center", fontsize=8)
        return figure
    widths = {group: max(len(members), 3) for group, members in groups.items()}
    lines, widest = _lines(widths), max(widths.values())
    figure = new_figure(max(PAGE, 0.35 * widest + 2.0), 5.8 * len(lines))
    parts = figure.subfigures(len(lines), 1, squeeze=False)[:, 0]
    for part, line in zip(parts, lines, strict=True):
        columns = [widths[group] for group in line]
        if slack := widest - sum(columns):
            columns.append(slack)  # stays empty: all combinations are as far from each other
        panels = part.subplots(3, len(columns), sharex="col", squeeze=False, width_ratios=columns)
        for axes in panels[:, len(line) :].flat:
            axes.remove()
        for column, (case, f_omega) in zip(panels.T, line, strict=False):
            _draw_group(column, sorted(groups[case, f_omega], key=_key), table)
            column[0].set_title(f"E = {case.E:g}, K = {case.K:g}\n{titles.speed(f_omega)}", fontsize=8)
        for axes, (_, _, text) in zip(panels[:, 0], _PANELS, strict=True):
            axes.set_ylabel(text, fontsize=8)
    panels[-1, 0].set_xlabel("blades: scatter of length, of frequency", loc="left")
    return figure


def _lines(widths: dict[tuple, int]) -> list[list[tuple]]:
    """Break groups of these widths into lines that are no wider than the widest group."""
    lines: list[list[tuple]] = [[]]
    for group in widths:
        if sum(widths[member] for member in (*lines[-1], group)) > max(widths.values()):
            lines.append([])
        lines[-1].append(group)
    return lines


def _draw_group(column: np.ndarray, members: list[Combination], table: pd.DataFrame) -> None:
    """Draw the combinations of one coating and speed into a column of panels."""
    rows = _rows_of(members, table)
    for axes, (name, colour, _) in zip(column, _PANELS, strict=True):
        for place, (member, row) in enumerate(zip(members, rows, strict=True)):
            scale = 1 if name == "amplification" else member.blades
            low, middle, high = (scale * row[f"{name}_{statistic}"] for statistic in ("p05", "median", "p95"))
            axes.plot([place, place], [low, high], color=colour, linewidth=1.5)
            axes.plot(place, middle, "o", color=colour, markersize=3.5)
        axes.axhline(1.0, color=GREY, linewidth=0.6)
        axes.grid(axis="y")
        axes.set_ylim(bottom=0)
    column[-1].set_xticks(range(len(members)), [label(member) for member in members], rotation=90, fontsize=9)


def _key(combination: Combination) -> tuple:
    description = described(combination)
    return tuple(description[name] for name in WHAT)


def _rows_of(members: list[Combination], table: pd.DataFrame) -> list[pd.Series]:
    by_key = table.set_index(WHAT)
    return [by_key.loc[_key(member)] for member in members]


@styled
def rotor_sweeps(plan: Plan, table: pd.DataFrame) -> Figure:
    """Draw amplitude and share of divergent rows over the speed, a column for each coating of the sweeps."""
    groups: dict[CoatingCase, list[Combination]] = {}
    for combination in plan.swept:
        groups.setdefault(combination.case, []).append(combination)
    figure = new_figure(max(PAGE, 1.7 * len(groups) + 0.8), 4.6)
    panels = figure.subplots(2, len(groups), sharex=True, sharey="row", squeeze=False, height_ratios=(3, 2))
    for (upper, lower), (case, members) in zip(panels.T, groups.items(), strict=True):
        members = sorted(members, key=_key)
        rows = _rows_of(members, table)
        speeds, single = np.array([(member.f_omega, member == member.alone) for member in members]).T
        _draw_sweep(upper, lower, pd.DataFrame(rows).reset_index(drop=True), speeds, single.astype(bool))
        upper.set_title(f"E = {case.E:g}, K = {case.K:g}\nθ = {case.theta:g} rad", fontsize=8)
    panels[0, 0].set(ylabel="amplitude (mm)", ylim=(0, None))
    panels[1, 0].set(ylabel="share of the rows", ylim=(-0.03, 1.03))
    panels[1, 0].set_xlabel(r"rotational frequency $f_\Omega$ (normalised)", loc="left")
    handles = [line for axes in panels[:, 0] for line in axes.get_legend_handles_labels()[0]]
    figure.legend(handles=handles, loc="outside lower center", ncols=2, fontsize=8)
    return figure


def _draw_sweep(upper: Axes, lower: Axes, rows: pd.DataFrame, speeds: np.ndarray, single: np.ndarray) -> None:
    nominal, drawn, drawn_speeds = rows[single], rows[~single], speeds[~single]
    look = {"color": GREY, "ms": 2.5, "lw": 0.8, "label": "single nominal blade"}
    _draw_broken(upper, speeds[single], 1e3 * nominal.row_amplitude_median, "o-", **look)
    low, middle, high = (1e3 * drawn[f"row_amplitude_{statistic}"] for statistic in ("p05", "median", "p95"))
    upper.vlines(drawn_speeds, low, high, color=DARK, linewidth=0.8)
    look = {"color": DARK, "ms": 3, "lw": 1.0, "label": "row: median, 5 to 95 % of the draws"}
    _draw_broken(upper, drawn_speeds, middle, "o-", **look)
    for name, line, colour, text in (
        ("divergent_rows", "s--", ORANGE, "diverge"),
        ("unbounded_rows", "o-", BLUE, "leave the displacement limit"),
    ):
        look = {"color": colour, "ms": 3, "lw": 1.0, "label": text}
        _draw_broken(lower, drawn_speeds, drawn[name] / drawn["rows"], line, **look)
    for axes in (upper, lower):
        axes.grid(axis="y")


def _draw_broken(axes: Axes, speeds: np.ndarray, values: pd.Series, line: str, **look) -> None:
    """Draw a line with a gap where no speed was run for much longer than usual."""
    steps = np.diff(speeds)
    gaps = np.flatnonzero(steps > _GAP * np.median(steps)) + 1 if steps.size else []
    broken = (np.insert(np.asarray(numbers, dtype=float), gaps, np.nan) for numbers in (speeds, values))
    axes.plot(*broken, line, **look)
