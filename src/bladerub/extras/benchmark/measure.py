"""Speeds of the time loop, measured side by side in one process.

Every loop integrates the same two revolutions from rest: once on a casing so near that the tip touches it in
a third of the steps, once vibrating freely far from it. Rounds take turns, and the median counts.
"""

import statistics
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd
from numba import njit

from bladerub.blade.model import N_INTERFACE, ReducedBlade
from bladerub.contact.kernel.loop import Progress, Simulation
from bladerub.contact.run import simulate
from bladerub.contact.setup import set_up
from bladerub.contact.spec import RunSpec
from bladerub.extras.benchmark import plain, record
from bladerub.extras.benchmark.estimate import estimate
from bladerub.numerics.vectors import LANES, broadcast, lane_sum
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases, run_spec, speeds

SHARE, REVOLUTIONS = 1 / 3, 2  # share of the steps in contact
REPEATS = 25  # marches of the loop of the study in each round: free ones take half a millisecond
PEAK_TURNS = 2_000_000
PEAK_CHAINS = 12  # products and sums in progress at once, to keep a processor busy: fewer than its registers
FLOPS_PER_MODE = 7  # of a step by itself: recurrence 3, damping loss 4; 2 more for each coordinate of the tip
FLOPS_PER_FLIGHT = 29  # of a mode: increment and last step 9, damping loss 12, mean 4, bound 4; and the tip
FLOPS_PER_ELEMENT = 17 + 52  # force once, and wear with its ledger
FLOPS_PER_NODE = 60
FLOPS_PER_TURN = PEAK_CHAINS * LANES * 2


def benchmark(
    blade: ReducedBlade, config: Config, rounds: int, cores: int | None, progress: Callable[[str], None]
) -> dict[str, Any]:
    """Measure the loop beside plain ones and the processor: the figures of ``bladerub benchmark``."""
    progress("finding a run with contact in a third of the steps")
    touching, share = in_contact(blade, middle_run(config))
    free = replace(touching, clearance=(blade.length, blade.length), initial_displacement=1e-6 * blade.length)
    progress("compiling the plain loop")
    specs = {"contact": touching, "free": free}
    in_python = plain.integrator(touching.coating.element_law)
    compiled = njit(in_python)
    _plain(compiled, blade, touching, 1)
    multiply_and_add(1)

    seconds: dict[str, list[dict[str, float]]] = {name: [] for name in specs}
    operations: list[float] = []
    for number in range(rounds):
        progress(f"round {number + 1} of {rounds}")
        operations.append(PEAK_TURNS * FLOPS_PER_TURN / _timed(multiply_and_add, PEAK_TURNS))
        for name, spec in specs.items():
            per_element = set_up(blade, spec)[1].steps_per_element
            steps = per_element * spec.coating.n_elements * spec.revolutions
            plainly = (_plain(loop, blade, spec, steps) / steps for loop in (in_python, compiled))
            loops = (*plainly, production(blade, spec) / steps)
            seconds[name].append(dict(zip(record.LOOPS, loops, strict=True)))
    progress("timing runs drawn from the study")
    study = estimate(blade, config, cores or record.cores())
    tables = {name: pd.DataFrame(rows) for name, rows in seconds.items()}
    rates = {
        loop: {name: 1 / table[loop].median() for name, table in tables.items()} for loop in record.LOOPS
    }
    figures = record.describe() | {"rounds": rounds, "modes": set_up(blade, touching)[0].omega.size}
    figures |= {"contact_share": share, "steps_per_second": rates}
    figures["peak_flops"] = statistics.median(operations)
    for name, ending in (("contact", ""), ("free", "_free")):
        table, flops = tables[name], useful_flops(blade, specs[name])
        for loop in ("numpy", "numba"):
            figures[f"ratio_to_{loop}{ending}"] = (table[loop] / table.production).median()
        figures[f"fraction_of_peak_{name}"] = (flops / table.production / operations).median()
    return figures | study


@njit
def multiply_and_add(n):
    """Do what a processor can do at best, `n` times in each chain; no two start alike and become one."""
    factor, addend = broadcast(0.999), broadcast(0.001)
    a, b, c, d = broadcast(1.0), broadcast(1.1), broadcast(1.2), broadcast(1.3)
    e, f, g, h = broadcast(1.4), broadcast(1.5), broadcast(1.6), broadcast(1.7)
    i, j, k, m = broadcast(1.8), broadcast(1.9), broadcast(2.0), broadcast(2.1)
    for _ in range(n):
        a, b, c, d = a * factor + addend, b * factor + addend, c * factor + addend, d * factor + addend
        e, f, g, h = e * factor + addend, f * factor + addend, g * factor + addend, h * factor + addend
        i, j, k, m = i * factor + addend, j * factor + addend, k * factor + addend, m * factor + addend
    return lane_sum(((a + b) + (c + d)) + ((e + f) + (g + h)) + ((i + j) + (k + m)))


def in_contact(blade: ReducedBlade, spec: RunSpec) -> tuple[RunSpec, float]:
    """Find the interference of the casing that gives contact in about `SHARE` of the steps; return both."""
    upper, lower = 2 * spec.casing.amplitude, 0.0
    for _ in range(12):
        interference = 0.5 * (upper + lower)
        nearer = replace(spec, casing=replace(spec.casing, interference=interference))
        result = simulate(blade, nearer)
        share = result.n_contact_steps / result.n_steps
        lower, upper = (lower, interference) if share > SHARE else (interference, upper)
    return nearer, share


def useful_flops(blade: ReducedBlade, spec: RunSpec) -> float:
    """Simulate a run, and count the useful operations of its mean step; comparisons are not."""
    rule, simulation = set_up(blade, spec)
    n, n_under = rule.omega.size, int(2 * simulation.tip.half_width) + 1
    progress = pd.DataFrame([_revolve(simulation) for _ in range(spec.revolutions)]).sum()
    steps, flights, touching = progress[["n_steps", "n_flights", "n_contact_steps"]]
    tip = 2 * 2 * blade.n_interface  # product and sum for each coordinate
    contact = tip * n + tip * blade.n_interface * 2
    contact += blade.n_interface * (n_under * FLOPS_PER_ELEMENT + FLOPS_PER_NODE)
    single = steps - flights * simulation.flight.n_steps
    free = (FLOPS_PER_MODE + tip) * single + (FLOPS_PER_FLIGHT + tip) * flights
    return (n * free + contact * touching) / steps


def middle_run(config: Config) -> RunSpec:
    """Describe the run of the middle coating and speed of the study."""
    cases = [replace(case, law="theta") for case in coating_cases(config) if np.isfinite(case.E)]
    grid = speeds(config)
    spec = run_spec(config, cases[len(cases) // 2], grid[len(grid) // 2])
    return replace(spec, revolutions=REVOLUTIONS, scheme="exponential")


def cost_by_nodes(config: Config, counts: Sequence[int], rounds: int) -> dict[str, float]:
    """Return the time of a simulation over that with eight nodes, by the number of nodes, on one mesh."""
    from bladerub.extras.verification.refinement import blade_with  # other measurements do without

    blades = {n: blade_with(config, n) for n in (N_INTERFACE, *counts)}
    spec, _ = in_contact(blades[N_INTERFACE], middle_run(config))
    seconds = [{n: production(blade, spec) for n, blade in blades.items()} for _ in range(rounds)]
    return {str(n): statistics.median(row[n] / row[N_INTERFACE] for row in seconds) for n in counts}


def _timed(function: Callable, *arguments: Any) -> float:
    start = time.thread_time()  # other processes and threads do not count
    function(*arguments)
    return time.thread_time() - start


def _plain(integrate: Callable, blade: ReducedBlade, spec: RunSpec, steps: int) -> float:
    arguments = plain.arguments(spec.coating.element_law, *set_up(blade, spec))
    return _timed(integrate, *arguments, np.zeros(steps))


def production(blade: ReducedBlade, spec: RunSpec) -> float:
    """Time all revolutions of a run by the loop of the study, s."""
    repeated = (set_up(blade, spec)[1] for _ in range(REPEATS))
    return statistics.median(
        sum(_timed(_revolve, simulation) for _ in range(spec.revolutions)) for simulation in repeated
    )


def _revolve(simulation: Simulation) -> Progress:
    return simulation.advance(np.zeros(simulation.stator.n_elements))
