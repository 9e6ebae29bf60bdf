"""The runs of a study on a GPU: how fast, and how equal to those on this processor."""

import time
from collections.abc import Callable
from functools import partial
from operator import attrgetter
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import simulate
from bladerub.extras.benchmark import record
from bladerub.extras.gpu.batch import simulate_many
from bladerub.extras.study_runs import study_runs
from bladerub.io.errors import BadInput
from bladerub.settings.study import Config
from bladerub.study.grid import run_spec
from bladerub.study.solver import each_done

_COMPARED = attrgetter("status", "n_steps", "n_contact_steps", "revolution_peak", "energy.residual")
"""What is kept of a result, since all of them would fill the memory."""


def compare(
    blade: ReducedBlade,
    config: Config,
    device: Callable[..., Any],
    n_compared: int,
    report: Callable[[str], None] = lambda line: None,
) -> dict[str, Any]:
    """Compute all runs of single blades on coatings of the study `config` on a GPU, and some here as well.

    `device` is `bladerub.extras.gpu.device.run`, or takes its arguments; `n_compared` runs, at even
    distances in the list of the study, are repeated on all cores. Returns numbers of `record.GPU_COLUMNS`:
    ``kernel_s`` of the loops, ``gpu_s`` with what the host does, ``seconds_per_run`` of a core, and the
    relative error of the largest displacement in a revolution, the largest of a run.
    """
    single = [run_spec(config, run.case, run.f_omega) for run in study_runs(config) if not run.row]
    described = [spec for spec in single if not (spec.coating.is_rigid or spec.coating.coulomb)]
    if not described:
        raise BadInput("--gpu: the study has no coating with theta, whose runs alone are on a GPU")
    kernel, handed_over = [], []

    def note(runs: int, line: str) -> None:
        handed_over.append(runs)
        report(line)

    watched = partial(device, watch=kernel.append)
    start = time.perf_counter()
    gpu_runs = {n: _COMPARED(result) for n, result in simulate_many(blade, described, watched, note)}
    seconds = time.perf_counter() - start
    numbers = np.linspace(0, len(described) - 1, min(n_compared, len(described))).astype(int).tolist()
    report(f"{len(numbers)} runs on this processor")

    def timed_run(number: int) -> tuple[tuple, float]:
        start = time.thread_time()  # other processes and threads do not count
        result = simulate(blade, described[number])
        return _COMPARED(result), time.thread_time() - start

    cpu_runs = dict(each_done(timed_run, numbers, record.cores()))
    steps = sum(n_steps for _, n_steps, *_ in gpu_runs.values())
    figures = {name: record.describe()[name] for name in ("processor", "cores")}
    figures |= {"gpu_runs": len(described), "handed_over": sum(handed_over), "kernel_s": sum(kernel)}
    figures |= {"gpu_s": seconds, "gpu_steps_per_second": steps / sum(kernel)}
    figures |= {"compared_runs": len(numbers)}
    figures |= {"seconds_per_run": float(np.mean([cost for _, cost in cpu_runs.values()]))}
    return figures | agreement([(gpu_runs[number], cpu_runs[number][0]) for number in numbers])


def agreement(pairs: list[tuple[tuple, tuple]]) -> dict[str, float]:
    """Compare what is kept of runs on the GPU with the same here, see `compare`."""
    columns = ["status", "steps", "contact_steps", "peak", "residual"]
    on_gpu, here = (pd.DataFrame(runs, columns=columns) for runs in zip(*pairs, strict=True))
    errors = [np.nanmax(np.abs(error)) for error in on_gpu.peak / here.peak - 1]
    quantiles = {"median": 0.5, "p95": 0.95, "p99": 0.99, "largest": 1.0}
    return {
        **{f"same_{name}": int((on_gpu[name] == here[name]).sum()) for name in columns[:3]},
        **{f"peak_error_{name}": float(np.quantile(errors, share)) for name, share in quantiles.items()},
        "largest_residual": float(on_gpu.residual.max()),
    }
