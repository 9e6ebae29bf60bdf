"""Remedies for Snakemake 9.27, at the plan and at the start of an invocation.

Its own lock outlives a killed process and has to be removed by hand (``--unlock``), before anything can be
planned; so the profile switches it off (``nolock``). A claim here is a file that its process locks: the
kernel drops that lock when the process dies.
"""

import atexit
import json
import math
import os
import re
import signal
import sys
import threading
import time
import uuid
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path
from typing import Any

from bladerub.io import lock
from bladerub.io.errors import BadInput

_SECOND_INTERRUPT = 5.0  # s

START_OF_JOBS = Path(__file__).with_name("start_of_jobs")  # for the ``PYTHONPATH`` of jobs: executed there
_DEFAULT_JOB_RATE = (100, 1)  # jobs, seconds


def begin() -> None:
    """Ignore a second Ctrl-C for a few seconds: it would break off what ends the jobs, in a traceback."""
    last = -math.inf

    def interrupt(number: int, frame: Any) -> None:
        nonlocal last
        previous, last = last, time.monotonic()
        if last - previous > _SECOND_INTERRUPT:
            signal.default_int_handler(number, frame)

    if signal.getsignal(signal.SIGINT) is signal.default_int_handler:
        signal.signal(signal.SIGINT, interrupt)


def start(workflow: Any, results: Iterable[str]) -> None:
    """Claim the files of Snakemake's `workflow`, be ready for what ends it, and `date_back` files."""
    if re.search(r"[\s'\"\\$`&;|<>()*?[\]!]", sys.executable):
        raise BadInput(
            f"{sys.executable}: Snakemake does not quote the path of Python for its jobs; make the "
            "environment in a folder without spaces and special characters (that of the study may have them)"
        )
    persistence = workflow.persistence
    if claim(persistence.path / "claims", persistence.all_outputfiles(), persistence.all_inputfiles()):
        print("bladerub: the last snakemake here was killed; what it had finished is kept", file=sys.stderr)
    _handle_termination_beside()
    _schedule_by_events(workflow)
    paths = [str(START_OF_JOBS), os.environ.get("PYTHONPATH")]
    os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, paths))
    for folder in results:
        date_back(folder)


def claim(folder: str | Path, outputs: Iterable[str], inputs: Iterable[str]) -> bool:
    """Claim `outputs` to write and `inputs` to read for this process; return whether one was killed before.

    A claim is a file in `folder` and goes with its process; those of killed ones are deleted. Raises
    `BadInput` if another living process makes what this one makes or needs, or needs what this one makes.
    """
    folder, killed = Path(folder), False
    makes, needs = set(map(str, outputs)), set(map(str, inputs))
    with lock.held(folder / ".lock", lambda: None):
        for path in sorted(folder.glob("*.json")):
            if dead := lock.attempt(path):
                path.unlink()
                dead.close()
                killed = True
                continue
            other = json.loads(path.read_text(encoding="utf-8"))
            if common := (makes | needs) & set(other["makes"]) | makes & set(other["needs"]):
                problem = f"another snakemake is at work in this folder, on {min(common)}"
                raise BadInput(f"{problem}: wait for its end")
        path = folder / f"{uuid.uuid4().hex}.json"
        stream = lock.attempt(path)
        json.dump({"makes": sorted(makes), "needs": sorted(needs)}, stream)
        stream.flush()
    atexit.register(lambda: (path.unlink(missing_ok=True), stream.close()))
    return killed


def date_back(results: str | Path) -> None:
    """Give files of the future the present time: Snakemake refuses what follows from them, without a cure."""
    now, n_future = time.time(), 0
    for folder, _, names in os.walk(results):
        for path in (os.path.join(folder, name) for name in names):
            with suppress(OSError):
                if os.lstat(path).st_mtime > now + 1:
                    os.utime(path, (now, now), follow_symlinks=False)
                    n_future += 1
    if n_future:
        text = f"files of the future, by a clock that was ahead: {n_future}; they are of now"
        print(f"bladerub: {text}", file=sys.stderr)


def _handle_termination_beside() -> None:
    """Let a thread of its own execute Snakemake's handler of SIGTERM.

    The handler waits for the lock of the scheduler (``JobScheduler.exit_gracefully`` of Snakemake 9.27).
    Python executes handlers in the main thread, which would wait for itself where it holds that lock.
    """
    handler = signal.getsignal(signal.SIGTERM)
    if callable(handler):
        signal.signal(
            signal.SIGTERM, lambda *arguments: threading.Thread(target=handler, args=arguments).start()
        )


def _schedule_by_events(workflow: Any) -> None:
    """Let Snakemake look for jobs when one ends, and not all the time.

    Its limit of 100 jobs a second, where none is given, sets a timer of a second in each round of the
    scheduler, which begins another: each job that ends adds a round a second, up to the end of the study.
    """
    scheduler = workflow.scheduler
    limiter = scheduler.job_rate_limiter
    if workflow.local_exec and limiter and (limiter.max_jobs, limiter.timespan) == _DEFAULT_JOB_RATE:
        scheduler.job_rate_limiter = None
