"""The start of every job of the workflow: where it says what it does, and how it reports an error."""

import atexit
import gc
import sys
from contextlib import suppress
from pathlib import Path
from types import TracebackType

from bladerub.io import errors

_ALLOCATIONS = 100_000
"""Objects made, less those deleted, after which garbage is looked for; of Python they are 700."""


def log_to(path: str | Path) -> None:
    """Send standard error to the log at `path`, each line as it comes.

    The error of a file or input is then reported in one line, in the log and on the former standard error, so
    that it is seen even if the log is on a full disk. The traceback of any other goes to the log, its last
    line to both.
    """
    collect_seldom()
    sys.stderr = open(path, "w", buffering=1, encoding="utf-8")  # noqa: SIM115 (a traceback must reach it)
    sys.excepthook = _report


def collect_seldom() -> None:
    """Look for garbage more seldom, and not at the end of this process, which does one thing and ends.

    Modules stay to the end: to go through all of them again and again takes a quarter of the time of a job
    that draws a figure.
    """
    gc.set_threshold(_ALLOCATIONS)
    atexit.register(gc.freeze)


def log(line: object) -> None:
    """Print a line to the log of this job."""
    print(line, file=sys.stderr)


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
