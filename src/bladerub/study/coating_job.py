"""The job of one coating: every run that is missing or stale, and the manifest of all."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from bladerub import datafile
from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import simulate
from bladerub.study.grid import CoatingCase, keeps_history, run_spec, speed_name, speeds
from bladerub.study.key import run_key
from bladerub.study.shelf import shelve, unshelve
from bladerub.study.store import ManifestRow, is_current, write_run


@dataclass(frozen=True)
class RunDone:
    """Report of one computed run; its string is a line for a log.

    Parameters
    ----------
    number, total : int
        This run among those that had to be computed.
    file : str
        Name of the run file.
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


def _ignore(done: RunDone) -> None:
    """Report to nobody."""


def compute_missing(
    config: Mapping[str, Any],
    case: CoatingCase,
    blade: ReducedBlade,
    folder: str | Path,
    blade_digest: str,
    report: Callable[[RunDone], None] = _ignore,
) -> list[ManifestRow]:
    """Compute those runs of one coating whose file is missing or stale.

    Each run is written as soon as it is done, so an interrupted job continues where it stopped. Runs that
    are no longer in the plan are left where they are. A stale run, of another study in the same place, is
    put on the shelf before its file is written anew, and taken back when its key is asked for again.

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
        Called with a `RunDone` after each computed run.

    Returns
    -------
    list of ManifestRow
        A row per speed of the study, for `bladerub.study.store.write_manifest`.
    """
    folder, analysis = Path(folder), config["analysis"]
    planned = []
    for f_omega in speeds(config):
        history = keeps_history(config, case, f_omega)
        spec = run_spec(config, case, f_omega)
        path = folder / f"{speed_name(f_omega)}.h5"
        planned.append((path, spec, run_key(spec, blade_digest, history, analysis), history))
    missing = [plan for plan in planned if not (is_current(plan[0], plan[2]) or unshelve(plan[0], plan[2]))]

    # a run takes as many steps as its revolutions take time: its cost goes as 1 / speed
    cost_left = sum(1 / spec.f_omega for _, spec, _, _ in missing)
    cost_done, start = 0.0, time.monotonic()
    for number, (path, spec, key, history) in enumerate(missing, 1):
        run_start = time.monotonic()
        result = simulate(blade, spec)
        shelve(path)
        write_run(path, spec, result, case, key, analysis, history)
        now = time.monotonic()
        cost_done += 1 / spec.f_omega
        cost_left -= 1 / spec.f_omega
        seconds_left = (now - start) * max(cost_left, 0.0) / cost_done
        report(RunDone(number, len(missing), path.name, result.status, now - run_start, seconds_left))

    return [
        ManifestRow(path.name, spec.f_omega, key, datafile.read_attributes(path)["status"])
        for path, spec, key, _ in planned
    ]
