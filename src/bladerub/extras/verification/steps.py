"""Steps and error of runs at several tolerances of the step, and with one step for all coatings."""

import math
from collections.abc import Callable, Iterator
from dataclasses import astuple, replace
from typing import Any

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import simulate
from bladerub.contact.steps import own_steps, with_steps
from bladerub.contact.strips import element_passage
from bladerub.extras.verification.differences import differences, largest
from bladerub.extras.verification.verify import NEIGHBOURS, REFINEMENT, TOLERANCE, StudyRun, explain
from bladerub.plots import style
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases, run_spec, speeds
from bladerub.study.variants import with_variant

TOLERANCES = (0.1, 0.03, 0.01, 0.003)

STUDY = 0.01  # the one of these that the study takes
UNIFORM = (20, 1.2e-6)  # one step for all coatings: least number in an element, longest in seconds
SAMPLE, SEED = 12, 11  # runs drawn for each Young modulus
_QUANTILES = {"median": 0.5, "nine runs in ten": 0.9}  # that are drawn

COLUMNS = [  # of ``steps.csv``; the tolerance of `UNIFORM` is empty
    *("casing", "E", "K", "theta", "law", "f_omega"),
    *("tolerance", "steps_per_element", "steps_per_revolution", "error", "sensitive", "energy_residual"),
]


def draw(config: Config) -> list[StudyRun]:
    """Draw `SAMPLE` runs of the study for each Young modulus, coating and speed evenly."""
    random, listed = np.random.default_rng(SEED), np.array(speeds(config))
    runs = []
    for E in sorted({case.E for case in coating_cases(config)}):
        cases = [case for case in coating_cases(config) if case.E == E]
        drawn = random.choice(listed, min(SAMPLE, listed.size), replace=False).tolist()
        runs += [StudyRun(cases[random.integers(len(cases))], f_omega) for f_omega in drawn]
    return runs


def table(
    blade: ReducedBlade, config: Config, report: Callable[[object], None] = lambda line: None
) -> pd.DataFrame:
    """Find steps and error of the drawn runs at each tolerance; a row each, with `COLUMNS`.

    The error is the largest of the `differences` from a run of `REFINEMENT` times the steps of the smallest
    tolerance. A run is sensitive, whatever the tolerance, if neighbouring starts `explain` its errors at that
    of the study.
    """
    rows, runs = [], draw(config)
    for number, run in enumerate(runs, 1):
        rows += _rows(blade, config, run)
        report(f"{number} of {len(runs)}, {run.name}")
    return with_variant(pd.DataFrame(rows, columns=[*COLUMNS, "variant"]), COLUMNS)


def _rows(blade: ReducedBlade, config: Config, run: StudyRun) -> Iterator[list[Any]]:
    spec, analysis = run_spec(config, run.case, run.f_omega), config.analysis
    passage = element_passage(blade, spec)
    free = replace(spec, steps_per_element=0, max_time_step=math.inf)
    specs = {tolerance: replace(free, tolerance=tolerance) for tolerance in TOLERANCES}
    specs[math.nan] = with_steps(spec, own_steps(passage, *UNIFORM))
    results = {tolerance: simulate(blade, run_spec) for tolerance, run_spec in specs.items()}
    steps = {tolerance: round(passage / result.time_step) for tolerance, result in results.items()}
    reference = simulate(blade, with_steps(spec, REFINEMENT * steps[min(TOLERANCES)]))
    errors = {
        tolerance: differences([result], [reference], analysis) for tolerance, result in results.items()
    }

    # Only what is beyond 1 % can be chaotic
    error, is_sensitive = errors[STUDY], False
    if TOLERANCE < max(error) < math.inf:
        starts = (simulate(blade, replace(specs[STUDY], initial_displacement=start)) for start in NEIGHBOURS)
        spread = largest(differences([start], [results[STUDY]], analysis) for start in starts)
        is_sensitive = explain(error, spread)
    *coating, variant = astuple(run.case)
    for tolerance, result in results.items():
        of_revolution = steps[tolerance] * spec.coating.n_elements
        row = [*coating, run.f_omega, tolerance, steps[tolerance], of_revolution, max(errors[tolerance])]
        yield [*row, is_sensitive, result.energy.residual, variant]


@style.styled
def draw_steps(table: pd.DataFrame) -> Figure:
    """Draw the error of `table` over the steps, but for chaotic runs; a line joins tolerances of one E."""
    calm = table[~table.sensitive.astype(bool)]
    figure = style.new_figure(style.PAGE, 0.5 * style.PAGE)
    panels = figure.subplots(1, 2, sharex=True, sharey=True)
    moduli = np.sort(calm.E.unique())
    shades = matplotlib.colormaps["viridis"](np.linspace(0, 0.9, moduli.size))
    colours = dict(zip(moduli, shades, strict=True))
    colours |= {E: style.DARK for E in moduli if np.isinf(E)}
    for axes, (name, quantile) in zip(panels, _QUANTILES.items(), strict=True):
        for E, runs in calm.groupby("E"):
            _draw(axes, runs, quantile, colours[E], "rigid" if np.isinf(E) else f"E = {E:g}")
        axes.axhline(STUDY, color=style.GREY, linewidth=0.8, linestyle=":")
        axes.set(xscale="log", yscale="log", xlabel="time steps in a revolution (thousand)", title=name)
        axes.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.xaxis.set_major_formatter(lambda steps, _: f"{steps / 1e3:g}")
        axes.xaxis.set_minor_locator(NullLocator())
        axes.grid()
    panels[0].set_ylabel("error")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside right center")
    return figure


def _draw(axes: Axes, runs: pd.DataFrame, quantile: float, colour: object, label: str) -> None:
    """Join the tolerances of one modulus; a full mark is the study's, a cross is one step for all."""
    by_tolerance = runs.groupby("tolerance", dropna=False)
    cost, error = by_tolerance.steps_per_revolution.median(), by_tolerance.error.quantile(quantile)
    rule, uniform = cost.index.notna(), cost.index.isna()
    axes.plot(cost[rule], error[rule], color=colour, marker="o", markersize=3, mfc="white", label=label)
    axes.plot(cost[STUDY], error[STUDY], color=colour, marker="o", markersize=5, label=f"_{label}")
    look = {"color": colour, "marker": "x", "linestyle": "none", "markersize": 5}
    axes.plot(cost[uniform], error[uniform], **look, label=f"_{label}")
