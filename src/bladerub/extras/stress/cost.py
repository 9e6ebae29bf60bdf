"""What the stress of a run costs, measured in turns with the run alone."""

import statistics
import tempfile
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.spec import RunSpec
from bladerub.extras.stress.run import BladeStress
from bladerub.extras.study_runs import study_runs
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study.grid import run_spec
from bladerub.study.job import compute
from bladerub.study.plan import planned_run
from bladerub.study.store import write_run

DRAWN = 24
"""Runs, at even distances in the list of the study."""


@threadpool_limits.wrap(limits=1, user_api="blas")  # as in the jobs of the study
def cost_of_stress(mesh: str | Path, blade: ReducedBlade, config: Config, rounds: int) -> float:
    """Return the CPU time of runs of the study with their stress, over that without.

    Each is set up, integrated and stored as the study does it. The median of so many `rounds` counts, of
    which one without effect comes first. `mesh` is the ``mesh.h5`` of the blade. Raises `BadInput` where it
    is of matrices alone.
    """
    stress, last = BladeStress(mesh, blade), config.analysis.spectrum_revolutions
    runs = study_runs(config)
    drawn, origin = runs[:: max(1, len(runs) // DRAWN)], provenance(config.plain())

    def stressed(blade: ReducedBlade, spec: RunSpec, progress: None) -> RunResult:
        return stress.of_run(spec, last)[0]

    def seconds(solve: Callable[..., RunResult], folder: Path) -> float:
        start = time.thread_time()  # other processes and threads do not count
        for number, run in enumerate(drawn):
            planned = planned_run(config, run_spec(config, run.case, run.f_omega), f"{number}.h5", False)
            stored = compute(run.case, planned, blade, "", config.analysis, solve=solve)
            write_run(folder / planned.file, stored, origin)
        return time.thread_time() - start

    with tempfile.TemporaryDirectory() as folder:
        cpu_time = partial(seconds, folder=Path(folder))
        ratios = [cpu_time(stressed) / cpu_time(simulate) for _ in range(rounds + 1)]
    return statistics.median(ratios[1:])
