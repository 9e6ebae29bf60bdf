"""What every job of the workflow reports: its log, from its start, errors, and how far it is."""

import atexit
import gc
import sys
import time
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from bladerub import plugins
from bladerub.io import errors

if TYPE_CHECKING:  # a job opens its log first
    from bladerub.study.job import RunDone
    from bladerub.study.manifest import ManifestRow

_ALLOCATIONS = 100_000  # objects made, less those deleted, before garbage is looked for; by default 700


def log_to(path: str | Path) -> None:
    """Send standard error to the log at `path`, each line as it comes.

    The error of a file or input is then reported in one line, in the log and on the former standard error, so
    that it is seen even if the log is on a full disk. Of any other the traceback goes to the log, its
    last line to both.
    """
    collect_seldom()
    sys.stderr = open(path, "w", buffering=1, encoding="utf-8")  # noqa: SIM115 (a traceback must reach it)
    sys.excepthook = _report


def collect_seldom() -> None:
    """Look for garbage more seldom, and not at the end of this process, which does one thing and ends.

    Modules stay to the end: to go through them again and again takes a quarter of a job that draws a figure.
    """
    gc.set_threshold(_ALLOCATIONS)
    atexit.register(gc.freeze)


def log(line: object) -> None:
    """Print a line to the log of this job."""
    print(line, file=sys.stderr)


class JobProgress:
    """Report of `bladerub.study.job.compute_missing` on the coating `name`, called with each finished run.

    The log of the job takes a line for each run in `folder`, with the time left; ``BARS`` show it elsewhere.
    """

    def __init__(self, name: str, folder: Path):
        self._name, self._computed, self._start = name, 0, time.monotonic()
        self._bars = [bar(name, folder) for bar in plugins.loaded("BARS").values()]

    def __call__(self, event: "RunDone | str") -> None:
        """Report one computed run, or what the job waits for."""
        log(event)
        if not isinstance(event, str):
            self._computed += 1
            for bar in self._bars:
                bar.show(event)

    def finish(self, rows: "Sequence[ManifestRow]") -> None:
        """Sum up in the log and on standard output what `compute_missing` returned."""
        for bar in self._bars:
            bar.close()
        longer = sum(bool(row.confirmation_key) for row in rows)
        unbounded = sum(row.status == "unbounded" for row in rows)
        summary = (
            f"{self._name}: {len(rows)} runs, {unbounded} of them unbounded, {longer} followed further; "
            f"{self._computed} computed in {time.monotonic() - self._start:.0f} s"
        )
        log(summary)
        print(summary)


def print_doubt(line: str) -> None:
    """Print a doubt about what this job made to its log and, to be seen, to the former standard error."""
    for stream in (sys.stderr, sys.__stderr__):
        with suppress(OSError):
            print(f"bladerub: {line}", file=stream)


def _report(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    if not isinstance(error, OSError | errors.BadInput):
        sys.__excepthook__(kind, error, trace)
        if not isinstance(error, Exception):  # of who stops the job
            return
        with suppress(OSError):
            reason = " ".join(str(error).split()) or kind.__name__
            print(f"bladerub: {reason} ({kind.__name__}; more in {sys.stderr.name})", file=sys.__stderr__)
        return
    for stream in (sys.stderr, sys.__stderr__):
        with suppress(OSError):
            print(errors.message_for(error), file=stream)
