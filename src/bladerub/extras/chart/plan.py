"""Which coatings and speeds the chart has, within ``chart.minutes``: fewer coatings, at speeds farther apart.

1. Without ``chart.minutes`` it is the whole chart; with it also, if the forecast is not longer.
2. Else the search of each coating begins at speeds twice as far apart. That saves a third of the runs; on the
   coatings of the study it misses few peaks (studies/chart/README.md), and twice as far again too many.
3. If that is still too long: the ends of E and K alone, then one modulus after the other, each in the middle
   of the widest gap on the logarithmic scale, as long as the forecast allows it. A larger budget adds to the
   coatings of a smaller one.

Engine orders, revolutions and all else of a run stay: its results are those of the whole chart. The plan
follows from the config alone, by the constants of `bladerub.extras.cores`. On another machine, or with a
blade of another cost, the chart takes longer or shorter, but is the same.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from bladerub.config.checks import casing_problems, reads
from bladerub.extras import cores
from bladerub.extras.chart.point import ChartSpeeds, chart_orders, nearest_speeds
from bladerub.io.errors import BadInput
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase

CORES = 2
"""Cores of the minutes if the config does not say: those of ``snakemake -j2``."""

RUNS_PER_HALVING = 4.2
"""Runs of a coating each time that the search halves the intervals around its maxima (61 of the study)."""

_FARTHER = 2
_JOBS = 9  # that would take as long as all beside the columns: tables and figures
_JOBS_IN_TURN = 3  # of these, each after the one before
_FEWEST = 2  # moduli of either kind: a chart is between four coatings


@reads("casings", "contact", "blade", "chart")
def problems(config: Config) -> Iterator[str]:
    """Yield what is wrong with the casing of the chart, whose coatings have its interference."""
    yield from casing_problems(config, config.chart.casing)


def check(config: Config) -> None:
    """Raise `BadInput` if the chart has no speeds, or an engine order no crossing."""
    highest, lowest = config.speeds.stop, min(chart_orders(config))
    if (start := config.chart.speeds.start) >= highest:
        raise BadInput(f"chart.speeds.start = {start:g}: must be below speeds.stop = {highest:g}")
    if lowest * highest < 1:  # rotation stiffens the blade: C1 is nowhere below its value at rest, 1
        raise BadInput(
            f"speeds.stop = {highest:g}: must be at least {1 / lowest:g} for the chart, or engine order "
            f"{lowest} does not cross the first frequency"
        )


class Plan(NamedTuple):
    """Part of the chart, its coatings being all combinations with each θ."""

    E: list[float]  # ascending, in moduli of the config
    K: list[float]
    multiple: int  # of the steps of ``chart.speeds``


def plan(config: Config) -> Plan:
    """Choose the part of the chart that the config grants minutes for; `BadInput` if they are too few."""
    E, K = config.chart.E, config.chart.K
    minutes = config.chart.minutes or math.inf
    for multiple in (1, _FARTHER):
        whole = Plan(E, K, multiple)
        if minutes == math.inf or expected_minutes(config, whole) <= minutes:
            return whole
    orders = {"E": _from_the_ends(E), "K": _from_the_ends(K)}
    smallest = chosen = Plan(sorted(orders["E"][:_FEWEST]), sorted(orders["K"][:_FEWEST]), _FARTHER)
    if expected_minutes(config, smallest) > minutes:
        needed = math.ceil(10 * expected_minutes(config, smallest)) / 10
        raise BadInput(f"chart.minutes = {minutes:g}: must be at least {needed:g} for the ends of E and K")
    while expected_minutes(config, grown := _grown(chosen, orders)) <= minutes:  # the whole is too long
        chosen = grown
    return chosen


def columns(config: Config) -> dict[str, list[CoatingCase]]:
    """List the coatings of each column, all K at one θ and E, by the name of the column."""
    casing, planned = config.chart.casing, plan(config)
    return {
        f"{casing}_E{E:g}_theta{theta:g}": [CoatingCase(casing, E, K, theta) for K in planned.K]
        for theta in config.chart.theta
        for E in planned.E
    }


def chart_speeds(config: Config) -> ChartSpeeds:
    """Choose the speeds of every point."""
    return nearest_speeds(config, plan(config).multiple)


def expected_minutes(config: Config, plan: Plan) -> float:
    """Forecast the minutes that a plan takes on ``chart.cores``, from the first job to the last figure."""
    chart, speeds = config.chart, nearest_speeds(config, plan.multiple)
    halvings = max(0.0, math.log2(plan.multiple * chart.speeds.step / config.speeds.step))
    runs = speeds.coarse.sum() + RUNS_PER_HALVING * halvings
    longer = cores.GROWING * speeds.uniform.sum() * config.analysis.divergence.confirmation_revolutions
    revolutions = runs * config.solver.revolutions + longer
    weights = [cores.run_cost(E, speeds.f_omega[speeds.coarse]).mean() for E in plan.E]
    n_columns = len(chart.theta) * len(plan.E)
    simulated = len(chart.theta) * len(plan.K) * sum(weights) * revolutions * cores.SECONDS_PER_REVOLUTION
    in_turn = max(cores.SECONDS_AT_FIRST.values()) + _JOBS_IN_TURN * cores.SECONDS_PER_JOB
    shared = simulated + (n_columns + _JOBS) * cores.SECONDS_PER_JOB
    return (in_turn + shared / (chart.cores or CORES)) / 60


def in_words(config: Config) -> str:
    """Say in a line which part of the chart is planned, and the minutes that are forecast for it."""
    chart, planned = config.chart, plan(config)
    part, all_coatings = (len(chart.theta) * len(moduli.E) * len(moduli.K) for moduli in (planned, chart))
    farther = "" if planned.multiple == 1 else f", at speeds {planned.multiple} times as far apart"
    minutes = f"about {expected_minutes(config, planned):.1f} min on {chart.cores or CORES} cores"
    return f"chart: {part:,} of {all_coatings:,} coatings{farther}; {minutes}, were nothing computed yet"


def _from_the_ends(values: Sequence[float]) -> list[float]:
    """Sort `values`, all positive: both ends, then each time the one that is farthest from those before."""
    left, ordered = list(values[1:-1]), [values[0], values[-1]]
    while left:
        distances = np.abs(np.log(np.divide.outer(left, ordered))).min(axis=1)
        ordered.append(left.pop(int(distances.argmax())))
    return ordered


def _grown(plan: Plan, orders: Mapping[str, Sequence[float]]) -> Plan:
    """Add a modulus to the kind whose chosen ones have the wider gap, of those that have another."""
    chosen = {name: getattr(plan, name) for name in orders}
    growing = [name for name in orders if len(chosen[name]) < len(orders[name])]
    name = max(growing, key=lambda name: np.diff(np.log(chosen[name])).max())
    return plan._replace(**{name: sorted(orders[name][: len(chosen[name]) + 1])})
