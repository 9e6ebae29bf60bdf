"""The job of one coating: every run that is missing or stale, and the rows of its manifest."""

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.gpu.many import LeftOut, simulate_many
from bladerub.contact.gpu.server import find
from bladerub.contact.result import RunResult
from bladerub.contact.row import simulate_row
from bladerub.contact.run import simulate
from bladerub.io import lock
from bladerub.io.checksum import file_checksum
from bladerub.io.provenance import provenance
from bladerub.study.cache import Entry
from bladerub.study.grid import CoatingCase
from bladerub.study.growth import needs_confirmation
from bladerub.study.manifest import CONFIRMATION, ManifestRow
from bladerub.study.parallel import each_done
from bladerub.study.plan import CoatingPlan, PlannedRun, growth_key, longer_run, on_gpu
from bladerub.study.store import MAPPED, StoredRun, read_run, stored_row, stored_run, write_run

Solve = Callable[..., RunResult]
Made = tuple[StoredRun, float]

LOCK = ".lock"
"""Empty file in the folder of the runs, locked by the job at work on them."""


@dataclass(frozen=True)
class RunDone:
    """Report of one computed run, whose string is a line for a log."""

    number: int  # of the `total` that had to be computed, longer ones counted separately
    total: int
    file: str
    status: str
    seconds: float  # of wall time
    seconds_left: float  # that the others will take, about

    def __str__(self) -> str:
        return (
            f"[{self.number}/{self.total}] {self.file} {self.status} in {self.seconds:.1f} s, "
            f"about {self.seconds_left:.0f} s left"
        )


class _Done(NamedTuple):
    """A run that is in its file."""

    key: str
    bytes: int
    checksum: str
    status: str
    unconverged_steps: int
    amplitude: np.ndarray


def compute_missing(
    config: Mapping[str, Any],
    plan: CoatingPlan,
    blade: ReducedBlade,
    folder: str | Path,
    blade_digest: str,
    report: Callable[[object], None] = lambda line: None,
    threads: int = 1,
) -> list[ManifestRow]:
    """Compute those runs of one coating whose file is missing or stale; return the rows of its manifest.

    A run that grows is then repeated, if the `plan` follows growth, for as many revolutions as the config has
    for its confirmation (see `bladerub.study.growth`). Each run is written as soon as it is done, so an
    interrupted job continues where it stopped. Runs that are no longer planned stay, stale ones are archived
    (`bladerub.study.cache`, whose `blade_digest` is that of the blade). One job at a time works on a folder:
    another, of another invocation, waits for its end and takes over what it has computed. `report` is called
    with a line for a log: a `RunDone` after each computed run, or a text before waiting. `threads` runs are
    computed at once, or all on a GPU where ``solver.device`` says so.
    """
    folder, settings = Path(folder), config["analysis"]["divergence"]
    complete = partial(_compute, config, plan.case, blade, folder, blade_digest, report, threads)
    with lock.held(folder / LOCK, lambda: report(f"another job is at work in {folder}: waiting for its end")):
        done = complete(plan.runs)
        growing = [
            run
            for run in plan.runs
            if plan.follow and needs_confirmation(done[run.file].amplitude, done[run.file].status, settings)
        ]
        longer = complete([longer_run(config, run) for run in growing])
        key = growth_key(config)
        return [_row(run, done[run.file], longer.get(f"{CONFIRMATION}/{run.file}"), key) for run in plan.runs]


def compute(
    case: CoatingCase,
    run: PlannedRun,
    blade: ReducedBlade,
    key: str,
    analysis: Mapping[str, Any],
    progress: Callable[[int], None] | None = None,
    solve: Solve | None = None,
) -> StoredRun:
    """Simulate what was planned, a single blade or a row, and return what is stored of it.

    `key` is that of the run, `analysis` of the config; `progress` is called with the number of revolutions
    done. A single blade is simulated by `solve`, by default `bladerub.contact.run.simulate`. Raises
    `ValueError` as `bladerub.contact.run.simulate` and `bladerub.contact.row.simulate_row`.
    """
    if run.row:
        outcome = simulate_row(blade, run.spec, run.row, progress)
        return stored_row(case, run.spec, run.row, outcome, key, analysis, run.keep_history)
    result = (solve or simulate)(blade, run.spec, progress)
    return stored_run(case, run.spec, result, key, analysis, run.keep_history)


def _row(run: PlannedRun, done: _Done, longer: _Done | None, growth_key: str) -> ManifestRow:
    return ManifestRow(
        file=run.file,
        f_omega=run.spec.f_omega,
        run_key=done.key,
        status=done.status,
        bytes=done.bytes,
        confirmation_key=longer.key if longer else "",
        confirmation_bytes=longer.bytes if longer else 0,
        checksum=done.checksum,
        confirmation_checksum=longer.checksum if longer else "",
        unconverged_steps=done.unconverged_steps,
        growth_key=growth_key,
    )


def _compute(
    config: Mapping[str, Any],
    case: CoatingCase,
    blade: ReducedBlade,
    folder: Path,
    blade_digest: str,
    report: Callable[[object], None],
    threads: int,
    runs: Sequence[PlannedRun],
) -> dict[str, _Done]:
    """Compute what is missing or stale of `runs`, which are of equal length; return all by file."""
    entries = {run.file: Entry(folder / run.file, run.key(blade_digest), MAPPED) for run in runs}
    missing = [run for run in runs if not entries[run.file].fetch()]
    origin, done = provenance(config), {}
    # a run takes as many steps as its revolutions take time: its cost goes as 1 / speed
    cost_left = sum(1 / run.spec.f_omega for run in missing)
    cost_done, start = 0.0, time.monotonic()

    def made(run: PlannedRun, solve: Solve | None = None) -> tuple[StoredRun, float]:
        run_start = time.monotonic()
        return compute(case, run, blade, entries[run.file].key, config["analysis"], solve=solve), run_start

    computed = _on_gpu(made, missing, blade, report) if on_gpu(config) else each_done(made, missing, threads)
    for number, (run, (stored, run_start)) in enumerate(computed, 1):
        entry = entries[run.file]
        entry.make_room()
        done[run.file] = _done(entry, stored, write_run(entry.path, stored, origin))
        cost_done += 1 / run.spec.f_omega
        cost_left -= 1 / run.spec.f_omega
        now, status = time.monotonic(), stored.attributes["status"]
        seconds_left = (now - start) * max(cost_left, 0.0) / cost_done
        report(RunDone(number, len(missing), run.file, status, now - run_start, seconds_left))
    for file in entries.keys() - done.keys():
        path = entries[file].path
        done[file] = _done(entries[file], read_run(path, {"revolution_amplitude"}), file_checksum(path))
    return done


def _on_gpu(
    made: Callable[[PlannedRun, Solve], Made],
    runs: Sequence[PlannedRun],
    blade: ReducedBlade,
    report: Callable[[object], None],
) -> Iterator[tuple[PlannedRun, Made]]:
    """Yield each run with ``made(run, solve)`` as it is done, rows of blades last."""

    def left_out(told: LeftOut) -> None:
        report(str(told))

    single = [run for run in runs if not run.row]
    for number, result in simulate_many(blade, [run.spec for run in single], find(), left_out):
        yield single[number], made(single[number], lambda *_, found=result: found)
    yield from ((run, made(run, simulate)) for run in runs if run.row)


def _done(entry: Entry, run: StoredRun, checksum: str) -> _Done:
    told, size = run.attributes, entry.path.stat().st_size
    unconverged = int(told["n_unconverged_steps"])
    return _Done(entry.key, size, checksum, told["status"], unconverged, run.data["revolution_amplitude"])
