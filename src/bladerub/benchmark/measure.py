"""Speeds of the time loop, measured side by side in one process.

Every loop marches the same two revolutions from rest: once on a casing brought so near that the tip touches
it in a third of the steps, once vibrating freely far from it. Rounds take turns, and the median counts.
"""

from __future__ import annotations

import os
import statistics
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Any

import numba
import numpy as np

from bladerub.benchmark import peak, plain
from bladerub.blade.model import ReducedBlade
from bladerub.contact import kernel
from bladerub.contact.run import SetUp, set_up, simulate
from bladerub.contact.spec import RunSpec
from bladerub.contact.vectors import LANES
from bladerub.study.grid import coating_cases, run_spec, speeds
from bladerub.study.verification import draw, study_runs

SHARE = 1 / 3
"""Share of the steps in contact."""
REVOLUTIONS = 2
PEAK_TURNS = 2_000_000
FULL_RUNS = 8

FLOPS_PER_MODE = 39
"""Of a free step: recurrence 3, damping loss 4, displacement of 16 coordinates of the tip 32."""
FLOPS_PER_PUSHED_MODE = 32
FLOPS_PER_RESPONSE = 2 * 16 * 16
RESPONSES = 3  # of the blade to the forces before, guessed and found
FLOPS_PER_BAR = 17 + 52  # force once, and wear with its ledger
FLOPS_PER_NODE = 60


def benchmark(
    blade: ReducedBlade,
    config: Mapping[str, Any],
    rounds: int,
    cores: int | None = None,
    progress: Callable[[str], None] = lambda stage: None,
) -> dict[str, Any]:
    """Measure the time loop beside plain loops and beside the arithmetic of the processor.

    Parameters
    ----------
    blade : ReducedBlade
        The blade.
    config : mapping
        The study; its abradable coating and speed in the middle of their lists are measured.
    rounds : int
        How often everything is measured.
    cores : int, optional
        On which the study would run, all there are by default.
    progress : callable, optional
        Called with the name of each stage.

    Returns
    -------
    dict
        The figures, as ``bladerub benchmark --json`` prints them.
    """
    progress("finding a run with contact in a third of the steps")
    touching, share = in_contact(blade, _middle_run(config))
    free = replace(touching, clearance=(blade.length, blade.length), initial_displacement=1e-6 * blade.length)
    progress("compiling the plain loop")
    compiled = numba.njit(plain.march)
    runs = {"contact": set_up(blade, touching), "free": set_up(blade, free)}
    _plain(compiled, runs["contact"], 1)
    peak.turns(1)

    seconds: dict[str, list[dict[str, float]]] = {name: [] for name in runs}
    operations: list[float] = []
    for number in range(rounds):
        progress(f"round {number + 1} of {rounds}")
        operations.append(PEAK_TURNS * peak.FLOPS_PER_TURN / _timed(peak.turns, PEAK_TURNS))
        for name, run in runs.items():
            steps = run.steps_per_element * run.stator.n_elements * REVOLUTIONS
            seconds[name].append(
                {
                    "numpy": _plain(plain.march, run, steps) / steps,
                    "numba": _plain(compiled, run, steps) / steps,
                    "production": _production(blade, touching if name == "contact" else free) / steps,
                }
            )
    progress(f"timing {FULL_RUNS} runs of the study")
    seconds_per_run, n_runs = _mean_run(blade, config)
    cores = cores or os.cpu_count() or 1
    median = statistics.median
    flops = {name: useful_flops(run, share if name == "contact" else 0.0) for name, run in runs.items()}
    return {
        "rounds": rounds,
        "modes": runs["contact"].rule.omega.size,
        "contact_share": share,
        "steps_per_second": {
            loop: {name: 1 / median(row[loop] for row in rows) for name, rows in seconds.items()}
            for loop in ("numpy", "numba", "production")
        },
        "ratio_to_numpy": median(row["numpy"] / row["production"] for row in seconds["contact"]),
        "ratio_to_numba": median(row["numba"] / row["production"] for row in seconds["contact"]),
        "ratio_to_numpy_free": median(row["numpy"] / row["production"] for row in seconds["free"]),
        "ratio_to_numba_free": median(row["numba"] / row["production"] for row in seconds["free"]),
        "peak_flops": median(operations),
        **{
            f"fraction_of_peak_{name}": median(
                flops[name] / row["production"] / rate for row, rate in zip(rows, operations, strict=True)
            )
            for name, rows in seconds.items()
        },
        "seconds_per_run": seconds_per_run,
        "runs": n_runs,
        "cores": cores,
        "study_minutes": n_runs * seconds_per_run / cores / 60,
    }


def in_contact(blade: ReducedBlade, spec: RunSpec) -> tuple[RunSpec, float]:
    """Bring the casing nearer or further until the tip touches it in about a third of the steps.

    Returns
    -------
    spec : RunSpec
        With the interference of the casing that was found.
    share : float
        Of steps in contact.
    """
    near, far = 2 * spec.casing.amplitude, 0.0
    for _ in range(12):
        interference = 0.5 * (near + far)
        nearer = replace(spec, casing=replace(spec.casing, interference=interference))
        result = simulate(blade, nearer)
        share = result.n_contact_steps / result.n_steps
        if share > SHARE:
            near = interference
        else:
            far = interference
    return nearer, share


def useful_flops(run: SetUp, share: float) -> float:
    """Count the useful operations of a step, `share` of all being in contact; comparisons are not."""
    n, rows = run.rule.omega.size, int(2 * run.tip.half_width) + 1
    contact = FLOPS_PER_PUSHED_MODE * n + RESPONSES * FLOPS_PER_RESPONSE
    contact += LANES * (rows * FLOPS_PER_BAR + FLOPS_PER_NODE)
    return FLOPS_PER_MODE * n + share * contact


def _middle_run(config: Mapping[str, Any]) -> RunSpec:
    cases = [case for case in coating_cases(config) if np.isfinite(case.E)]
    listed = speeds(config)
    spec = run_spec(config, cases[len(cases) // 2], listed[len(listed) // 2])
    return replace(spec, revolutions=REVOLUTIONS, scheme="exponential")


def _timed(function: Callable, *arguments: Any) -> float:
    start = time.thread_time()  # other processes and threads do not count
    function(*arguments)
    return time.thread_time() - start


def _plain(march: Callable, run: SetUp, steps: int) -> float:
    return _timed(march, *plain.arguments(run), np.zeros(steps))


def _production(blade: ReducedBlade, spec: RunSpec) -> float:
    run = set_up(blade, spec)
    parts = run.motion, run.stator, run.tip, run.state, run.steps_per_element
    displacement = np.zeros(run.stator.n_elements)
    return sum(_timed(kernel.revolve, *parts, displacement) for _ in range(REVOLUTIONS))


def _mean_run(blade: ReducedBlade, config: Mapping[str, Any]) -> tuple[float, int]:
    """Estimate CPU seconds of the mean run of the study from the cost of a step of some; count the runs."""
    runs = study_runs(config)
    steps = {f_omega: _steps(blade, config, f_omega) for f_omega in {run.f_omega for run in runs}}
    drawn = draw(runs, min(FULL_RUNS, len(runs)), seed=0)
    seconds = sum(_timed(simulate, blade, run_spec(config, run.case, run.f_omega)) for run in drawn)
    per_step = seconds / sum(steps[run.f_omega] for run in drawn)
    return per_step * statistics.mean(steps[run.f_omega] for run in runs), len(runs)


def _steps(blade: ReducedBlade, config: Mapping[str, Any], f_omega: float) -> int:
    spec = run_spec(config, coating_cases(config)[0], f_omega)
    return set_up(blade, spec).steps_per_element * spec.coating.n_elements * spec.revolutions
