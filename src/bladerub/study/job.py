"""The job of one coating: every run that is missing or stale, and the manifest of all."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import simulate
from bladerub.io import lock
from bladerub.study.archive import shelve, unshelve
from bladerub.study.grid import CoatingCase
from bladerub.study.growth import needs_confirmation
from bladerub.study.plan import PlannedRun, longer_run, planned_runs
from bladerub.study.store import ManifestRow, is_current, read_run, write_run

LOCK = ".lock"
"""File beside the runs that the job at work on them holds; empty."""


@dataclass(frozen=True)
class RunDone:
    """Report of one computed run; its string is a line for a log.

    Parameters
    ----------
    number, total : int
        This run among those that had to be computed; longer ones for confirmation are counted anew.
    file : str
        Name of the run file, in the folder of the coating.
    status : str
        ``completed`` or ``unbounded``.
    seconds : float
        Wall time of the run.
    seconds_left : float
        Estimated wall time of the runs still to compute.
    """

    number: int
    total: int
    file: str
    status: str
    seconds: float
    seconds_left: float

    def __str__(self) -> str:
        return (
            f"[{self.number}/{self.total}] {self.file} {self.status} in {self.seconds:.1f} s, "
            f"about {self.seconds_left:.0f} s left"
        )


def _ignore(line: object) -> None:
    """Report to nobody."""


def compute_missing(
    config: Mapping[str, Any],
    case: CoatingCase,
    blade: ReducedBlade,
    folder: str | Path,
    blade_digest: str,
    report: Callable[[object], None] = _ignore,
) -> list[ManifestRow]:
    """Compute those runs of one coating whose file is missing or stale.

    A run that grows is then repeated for as many revolutions as the config has for its confirmation (see
    `bladerub.study.growth`). Each run is written as soon as it is done, so an interrupted job continues
    where it stopped. Runs that are no longer in the plan are left where they are. A stale run, of another
    study in the same place, is put on the shelf before its file is written anew, and taken back when its
    key is asked for again. One job at a time works on a folder: another, of another invocation, waits for its
    end and takes over what it has computed.

    Parameters
    ----------
    config : mapping
        The study.
    case : CoatingCase
        The coating.
    blade : ReducedBlade
        The blade.
    folder : path-like
        Where the runs of this coating live.
    blade_digest : str
        From `bladerub.study.key.blade_digest`.
    report : callable, optional
        Called with a line for a log: a `RunDone` after each computed run, or a text before waiting.

    Returns
    -------
    list of ManifestRow
        A row per speed of the study, for `bladerub.study.store.write_manifest`.
    """
    folder, settings = Path(folder), config["analysis"]["divergence"]
    runs = planned_runs(config, case, folder, blade_digest)
    with lock.held(folder / LOCK, lambda: report(f"another job is at work in {folder}: waiting for its end")):
        outcomes = _compute(runs, folder, case, blade, config, report)
        outcomes |= {run.path: _stored(run.path) for run in runs if run.path not in outcomes}
        longer = {
            run.path: longer_run(config, run, blade_digest)
            for run in runs
            if needs_confirmation(outcomes[run.path].amplitude, outcomes[run.path].status, settings)
        }
        _compute(list(longer.values()), folder, case, blade, config, report)
        return [_row(run, outcomes[run.path].status, longer.get(run.path)) for run in runs]


def _row(run: PlannedRun, status: str, longer: PlannedRun | None) -> ManifestRow:
    confirmation = (longer.key, longer.path.stat().st_size) if longer else ()
    return ManifestRow(
        run.path.name, run.spec.f_omega, run.key, status, run.path.stat().st_size, *confirmation
    )


class _Outcome(NamedTuple):
    """What tells whether a run needs a longer one."""

    status: str
    amplitude: np.ndarray


def _stored(path: Path) -> _Outcome:
    run = read_run(path, {"revolution_amplitude"})
    return _Outcome(run.attributes["status"], run.data["revolution_amplitude"])


def _compute(
    plans: Sequence[PlannedRun],
    folder: Path,
    case: CoatingCase,
    blade: ReducedBlade,
    config: Mapping[str, Any],
    report: Callable[[object], None],
) -> dict[Path, _Outcome]:
    """Compute what is missing or stale of `plans`, all of as many revolutions, and return how it went."""
    missing = [
        plan for plan in plans if not (is_current(plan.path, plan.key) or unshelve(plan.path, plan.key))
    ]
    # a run takes as many steps as its revolutions take time: its cost goes as 1 / speed
    cost_left = sum(1 / plan.spec.f_omega for plan in missing)
    cost_done, start = 0.0, time.monotonic()
    outcomes = {}
    for number, plan in enumerate(missing, 1):
        run_start = time.monotonic()
        result = simulate(blade, plan.spec)
        shelve(plan.path)
        write_run(plan.path, plan.spec, result, case, plan.key, config, plan.keep_history)
        outcomes[plan.path] = _Outcome(result.status, result.revolution_amplitude)
        now = time.monotonic()
        cost_done += 1 / plan.spec.f_omega
        cost_left -= 1 / plan.spec.f_omega
        seconds_left = (now - start) * max(cost_left, 0.0) / cost_done
        file = plan.path.relative_to(folder).as_posix()
        report(RunDone(number, len(missing), file, result.status, now - run_start, seconds_left))
    return outcomes
