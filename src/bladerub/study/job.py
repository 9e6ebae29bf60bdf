"""The job of one coating: every run that is missing or stale, and the rows of its manifest."""

import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.io import lock
from bladerub.io.checksum import file_checksum
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study.cache import Entry
from bladerub.study.growth import needs_confirmation
from bladerub.study.manifest import ManifestRow
from bladerub.study.plan import CoatingPlan, PlannedRun, growth_key, longer_run
from bladerub.study.solver import Solver, each_done, rows, solver_of
from bladerub.study.store import MAPPED, StoredRun, read_run, stored_run, write_run


@dataclass(frozen=True)
class RunDone:
    """Report of one computed run, whose string is a line for a log."""

    number: int  # of the `total` to be computed, to which each longer one is added as it is begun
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


def compute_missing(
    config: Config,
    plan: CoatingPlan,
    blade: ReducedBlade,
    folder: str | Path,
    blade_digest: str,
    report: Callable[[object], None] = lambda line: None,
    threads: int = 1,
) -> list[ManifestRow]:
    """Compute those runs of one coating whose file is missing or stale; return the rows of its manifest.

    A run that grows is followed, if its plan says so, for as many revolutions as the config has for its
    confirmation (see `bladerub.study.growth`). Each run is written as soon as it and its longer one are
    done, so an interrupted job continues where it stopped. Runs that are no longer planned stay, stale ones
    are archived (`bladerub.study.cache`, whose `blade_digest` is that of the blade). One job at a time works
    on a folder: another, of another invocation, waits for its end and takes over what it has computed.
    `report` is called with a line for a log: a `RunDone` after each computed run, or a text before waiting.
    `threads` runs are computed at once, or all together by a solver that does so (`bladerub.study.solver`).
    """
    folder = Path(folder)
    job = _Job(config, plan, blade, blade_digest, report, threads, folder)
    waiting = f"another job is at work in {folder}: waiting for its end"
    with lock.held(folder / ".lock", lambda: report(waiting)):  # an empty file, locked by the job at work
        computed = job.complete(plan.runs)
        names = {"revolution_amplitude"}, {"status", "n_unconverged_steps", "energy_residual"}
        stored = [computed.get(run.file) or read_run(folder / run.file, *names) for run in plan.runs]
        longer = list(map(job.longer_of, plan.runs, stored))
        job.complete([run for run in longer if run])
        return list(map(job.row, plan.runs, stored, longer))


def compute_all(
    config: Config,
    plan: CoatingPlan,
    blade: ReducedBlade,
    blade_digest: str = "",
    report: Callable[[object], None] = lambda line: None,
    threads: int = 1,
    advance: Callable[[], object] = lambda: None,
    progress: Callable[[int], None] | None = None,
    solver: Solver | None = None,
) -> tuple[list[StoredRun], list[StoredRun | None]]:
    """Compute the runs that `compute_missing` would, all of them, and keep them in memory.

    Returns the runs of the `plan` in its order, and the longer run of each or None. `report` is called with
    the lines of the solver for a log, `advance` after each run of the plan, `progress` with the number of
    revolutions done of a run. Single blades are simulated by `solver`, by default that of the config. Raises
    `ValueError` as `bladerub.contact.run.simulate` and `bladerub.study.solver.rows`.
    """
    job = _Job(config, plan, blade, blade_digest, report, threads, progress=progress, solver=solver)
    stored, files = {}, {run.file for run in plan.runs}
    for run, outcome, _ in job.computed(plan.runs):
        stored[run.file] = outcome
        if run.file in files:
            advance()
    longer = [job.longer_of(run, stored[run.file]) for run in plan.runs]
    not_begun = [run for run in longer if run and run.file not in stored]
    stored |= {run.file: outcome for run, outcome, _ in job.computed(not_begun)}
    return [stored[run.file] for run in plan.runs], [stored[run.file] if run else None for run in longer]


@dataclass(frozen=True)
class _Job:
    """The job of one coating, see `compute_missing`."""

    config: Config
    plan: CoatingPlan
    blade: ReducedBlade
    blade_digest: str
    report: Callable[[object], None]
    threads: int
    folder: Path | None = None  # of the files; None for what stays in memory
    progress: Callable[[int], None] | None = None
    solver: Solver | None = None

    def longer(self, run: PlannedRun, amplitude: np.ndarray, status: str) -> PlannedRun | None:
        """Plan the longer run of one that grows and is to be followed; none grows that is one itself."""
        grows = run.follow and needs_confirmation(amplitude, status, self.config.analysis.divergence)
        return longer_run(self.config, run) if grows else None

    def longer_of(self, run: PlannedRun, stored: StoredRun) -> PlannedRun | None:
        return self.longer(run, stored.data["revolution_amplitude"], stored.attributes["status"])

    def entry(self, run: PlannedRun) -> Entry:
        return Entry(self.folder / run.file, run.key(self.blade_digest), MAPPED)

    def complete(self, runs: Sequence[PlannedRun]) -> dict[str, StoredRun]:
        """Compute what is missing or stale of `runs`, and what goes on of these, into their files.

        Returns of each computed run, by its file, what decides whether it goes on and what its manifest says.
        """
        missing = [run for run in runs if not self.entry(run).fetch()]
        # a run takes as many steps as its revolutions take time: its cost goes as 1 / speed
        costs = {run.file: 1 / run.spec.f_omega for run in missing}
        origin, total = provenance(self.config.plain()), len(missing)
        cost_done, start = 0.0, time.monotonic()
        done = {}
        for number, (run, stored, seconds) in enumerate(self.computed(missing), 1):
            entry = self.entry(run)
            entry.make_room()
            write_run(entry.path, stored, origin)
            if run.file in costs:
                cost_done += costs[run.file]
            else:  # a run that goes on
                total += 1
            seconds_left = (time.monotonic() - start) * max(sum(costs.values()) / cost_done - 1, 0.0)
            status = stored.attributes["status"]
            self.report(RunDone(number, total, run.file, status, seconds, seconds_left))
            amplitude = {"revolution_amplitude": stored.data["revolution_amplitude"]}
            done[run.file] = StoredRun(stored.attributes, amplitude)  # not all that a run has, for the memory
        return done

    def row(self, run: PlannedRun, stored: StoredRun, longer: PlannedRun | None) -> ManifestRow:
        """Describe the files of a run and of its longer one, as the manifest lists them."""
        entry = self.entry(run)
        row = ManifestRow(
            file=run.file,
            f_omega=run.spec.f_omega,
            run_key=entry.key,
            status=stored.attributes["status"],
            bytes=entry.path.stat().st_size,
            checksum=file_checksum(entry.path),
            unconverged_steps=int(stored.attributes["n_unconverged_steps"]),
            growth_key=growth_key(self.config),
            energy_residual=float(stored.attributes["energy_residual"]),
        )
        if longer is None:
            return row
        entry = self.entry(longer)
        return row._replace(
            confirmation_key=entry.key,
            confirmation_bytes=entry.path.stat().st_size,
            confirmation_checksum=file_checksum(entry.path),
        )

    def computed(self, runs: Sequence[PlannedRun]) -> Iterator[tuple[PlannedRun, StoredRun, float]]:
        """Yield each run with its seconds, then its longer one if the solver goes on; rows last."""
        case, analysis = self.plan.case, self.config.analysis

        def compute_row(run: PlannedRun) -> tuple[StoredRun, float]:
            start = time.monotonic()
            row = run.row, self.blade, case, run.spec, run.key(self.blade_digest)
            stored = rows().compute(*row, analysis, run.keep_history, self.progress)
            return stored, time.monotonic() - start

        def revolutions(number: int, result: RunResult) -> int:
            run = self.longer(single[number], result.revolution_amplitude, result.status)
            is_there = run and self.folder and self.entry(run).fetch()
            return run.spec.revolutions if run and not is_there else 0

        single = [run for run in runs if not run.row]
        specs, solver = [run.spec for run in single], self.solver or solver_of(self.config)
        how = self.threads, self.report, self.progress, revolutions
        for number, result, seconds in solver.simulate_many(self.blade, specs, *how):
            run = single[number]
            if result.revolution_amplitude.size > run.spec.revolutions:
                run = longer_run(self.config, run)
            key = run.key(self.blade_digest)
            yield run, stored_run(case, run.spec, result, key, analysis, run.keep_history), seconds
        rows_of_blades = [run for run in runs if run.row]
        for run, (stored, seconds) in each_done(compute_row, rows_of_blades, self.threads):
            yield run, stored, seconds
