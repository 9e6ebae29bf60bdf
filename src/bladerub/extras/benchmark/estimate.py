"""How long the whole study takes on this machine, and what the stress of its runs costs, from drawn ones.

1. Runs at even distances in the list of the study are computed and stored as the study does it, in as many
   threads as it would have jobs. Those that grow are followed further.
2. Repetitions of runs in further jobs (``COSTS`` of `bladerub.plugins`), such as the members of ensembles,
   cost what the drawn runs near a peak do. Their number is known but where two peaks share a speed.
3. The job of the runs and the map of each coating, and these further ones, start Python and import packages.

Not contained are the blade, tables and figures, and what Snakemake itself does.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from threadpoolctl import threadpool_limits

from bladerub import plugins
from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.spec import RunSpec
from bladerub.extras.benchmark.record import cores as cores_here
from bladerub.extras.study_runs import StudyRun, study_runs
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases, run_spec
from bladerub.study.job import compute_missing
from bladerub.study.maps import first_frequency
from bladerub.study.peaks import peak_orders
from bladerub.study.plan import CoatingPlan, planned_run
from bladerub.study.solver import each_done
from bladerub.study.store import stored_run, write_run

DRAWN, DRAWN_WITH_STRESS = 128, 24
_JOB_OF_RUNS = ("study.job", "study.maps")  # what the job of the runs and the map of a coating imports


def estimate(blade: ReducedBlade, config: Config, cores: int) -> dict[str, Any]:
    """Estimate the ``study_minutes`` on so many `cores`, and CPU seconds of a run, from `DRAWN` runs."""
    config = config.replaced("solver.device", "cpu")
    runs = study_runs(config)
    step = max(1, len(runs) // DRAWN)
    n_threads = min(cores, cores_here())  # at once, so that the cores share caches as in the study
    with tempfile.TemporaryDirectory() as folder:
        cost_of_run = partial(_cost, blade, config, Path(folder))
        costs = [cost for _, cost in each_done(cost_of_run, runs[step // 2 :: step], n_threads)]
    seconds_per_run, longer, is_near_a_peak = np.transpose(costs)
    totals = seconds_per_run + longer
    peak_totals = totals[is_near_a_peak == 1] if is_near_a_peak.any() else totals
    further = plugins.loaded("COSTS").values()
    members = sum(cost(config, case) for cost in further for case in coating_cases(config))
    modules = [*_JOB_OF_RUNS, *(place.partition(":")[0] for place in plugins.offered("COSTS").values())]
    starts = sum(map(_start, modules)) * len(coating_cases(config))
    seconds = len(runs) * totals.mean() + members * peak_totals.mean() + starts
    figures = {"seconds_per_run": float(seconds_per_run.mean()), "runs": len(runs), "members": members}
    return figures | {"cores": cores, "study_minutes": float(seconds) / cores / 60}


def _cost(blade: ReducedBlade, config: Config, folder: Path, run: StudyRun) -> tuple[float, float, bool]:
    """CPU time of a run and of what follows its growth, if it grows, s; and whether a peak is near."""
    spec = run_spec(config, run.case, run.f_omega)
    plan = CoatingPlan(run.case, (planned_run(config, spec, "run.h5", False, run.row),))
    start = time.thread_time()  # other processes and threads do not count
    (row,) = compute_missing(config, plan, blade, folder / run.name, "")
    seconds, revolutions = time.thread_time() - start, spec.revolutions
    if row.confirmation_key:  # it grew, and was followed
        revolutions = config.analysis.divergence.confirmation_revolutions
    per_run, (low, high) = seconds * spec.revolutions / revolutions, config.analysis.peaks.speed_window
    over_crossing = run.f_omega / first_frequency(blade, [run.f_omega])[0]
    is_near = any(low <= order * over_crossing <= high for order in peak_orders(config, run.case.casing))
    return per_run, seconds - per_run, is_near


def _start(module: str) -> float:
    """CPU time of a process that imports `module`, named below `bladerub`, s."""
    before = os.times()
    subprocess.run([sys.executable, "-c", f"import bladerub.{module}"], check=True)
    after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


@threadpool_limits.wrap(limits=1, user_api="blas")  # as in the jobs of the study
def cost_of_stress(mesh: str | Path, blade: ReducedBlade, config: Config, rounds: int) -> float:
    """Return the CPU time of stored runs with their stress over that without; median of the `rounds`.

    `mesh` is the ``mesh.h5`` of the blade. Raises `BadInput` where it is of matrices alone.
    """
    from bladerub.extras.stress.run import BladeStress  # other measurements do without

    stress, last = BladeStress(mesh, blade), config.analysis.spectrum_revolutions
    runs = study_runs(config)
    drawn, origin = runs[:: max(1, len(runs) // DRAWN_WITH_STRESS)], provenance(config.plain())

    def stressed(blade: ReducedBlade, spec: RunSpec) -> RunResult:
        return stress.of_run(spec, last)[0]

    def seconds(solve: Callable[..., RunResult], folder: Path) -> float:
        start = time.thread_time()
        for number, run in enumerate(drawn):
            spec = run_spec(config, run.case, run.f_omega)
            stored = stored_run(run.case, spec, solve(blade, spec), "", config.analysis, False)
            write_run(folder / f"{number}.h5", stored, origin)
        return time.thread_time() - start

    with tempfile.TemporaryDirectory() as folder:
        cpu_time = partial(seconds, folder=Path(folder))
        ratios = [cpu_time(stressed) / cpu_time(simulate) for _ in range(rounds + 1)]
    return statistics.median(ratios[1:])
