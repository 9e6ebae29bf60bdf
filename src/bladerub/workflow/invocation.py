"""What an invocation of the workflow clears away of those killed before it."""

import shutil
import signal
import sys
import tempfile
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import IO, Any

from bladerub.config import record
from bladerub.extensions.chart.point import PointRow
from bladerub.io import atomic, lock
from bladerub.io.errors import DamagedFile
from bladerub.study.manifest import ManifestRow, Row, listed_files
from bladerub.workflow import gpu


def begin(snakemake_folder: str | Path, results: str | Path) -> IO:
    """Clear away what keeps Snakemake from continuing, before it plans; keep the returned stream open.

    First, the lock of a killed Snakemake: Snakemake notes in files which files it makes, and takes any such
    note for that of a living process, until somebody calls it with ``--unlock``. So each invocation also
    shares a lock that the kernel drops when its process dies. If no other process holds that one, the notes
    are of a dead one and are deleted. If another does, they stay, and Snakemake decides by them whether the
    two conflict. (Without that lock, Snakemake's ``nolock``, two would delete each other's files.)

    Second, the manifest of a coating, or of rows of blades, that lists a run which is lost or of another
    size, and that of a column of the chart with such a point: without its manifest the job is planned again,
    and computes that alone.

    `snakemake_folder` is ``.snakemake`` of the working directory. Raises an `OSError` if a folder cannot be
    written.
    """
    locks = Path(snakemake_folder) / "locks"
    stream, alone = lock.share(Path(snakemake_folder) / "bladerub.lock")
    if not alone:
        _print("another snakemake is at work in this folder; if it keeps this one out, wait for its end")
    elif any(locks.glob("*.lock")):
        shutil.rmtree(locks)
        _print("the last snakemake here was killed; what it had finished is kept")
    manifests = (("runs/*/manifest.tsv", ManifestRow), ("rotor/runs/*/manifest.tsv", ManifestRow))
    for pattern, kind in (*manifests, ("chart/columns/*.tsv", PointRow)):
        for manifest in sorted(Path(results).glob(pattern)):
            _delete_if_wrong(manifest, kind)
    return stream


def _delete_if_wrong(manifest: Path, kind: type[Row]) -> None:
    try:
        lost = [file.path for file in listed_files(manifest, kind) if file.is_lost()]
    except DamagedFile as error:
        problem = str(error)
    else:
        if not lost:
            return
        problem = f"{lost[0]}: missing, or not as long as it was written"
    manifest.unlink(missing_ok=True)
    _print(f"{problem}; its job is planned again and computes only what is not there")


def _print(line: str) -> None:
    print(f"bladerub: {line}", file=sys.stderr)


_planned: list[tuple[str, Sequence[str], Mapping[str, Any], bool]] = []


def plan(
    results: str,
    files: Sequence[str],
    given: Mapping[str, Any],
    notes: Sequence[str] = (),
    on_gpu: bool = False,
) -> None:
    """Note what this invocation will `start`: its results folder, config files and values of ``--config``.

    `notes` on the config are printed, a line each. `on_gpu` is whether runs are computed on a GPU.
    """
    _planned[:] = [(results, files, given, on_gpu)]
    for note in notes:
        _print(note)


def start(workflow: Any) -> None:
    """Begin to compute what was planned: `prepare` its results folder, and record its config there.

    Called in ``onstart`` with Snakemake's ``workflow``. A Snakefile that takes in this workflow as a module
    calls it from its own, since Snakemake ignores that of a module.
    """
    _handle_termination_beside()
    _schedule_by_events(workflow)
    for results, files, given, on_gpu in _planned:
        prepare(results)
        record.write(results, files, given)
        if on_gpu and workflow.local_exec:  # a job on another machine has the GPU there
            gpu.start_server()


def _handle_termination_beside() -> None:
    """Let a thread of its own execute Snakemake's handler of SIGTERM.

    The handler waits for the lock of the scheduler (``JobScheduler.exit_gracefully`` of Snakemake 9.27).
    Python executes handlers in the main thread, which would wait for itself where it holds that lock.
    """
    handler = signal.getsignal(signal.SIGTERM)
    if callable(handler):
        signal.signal(signal.SIGTERM, lambda *at: threading.Thread(target=handler, args=at).start())


def _schedule_by_events(workflow: Any) -> None:
    """Let Snakemake look for jobs when one ends, and not all the time.

    Its limit of 100 jobs a second (Snakemake 9.27, where none is given) sets a timer of a second in each
    round of the scheduler, and the timer begins another round. So each job that ends adds a round a second,
    up to the end of the study.
    """
    scheduler = workflow.scheduler
    limiter = scheduler.job_rate_limiter
    if workflow.local_exec and limiter and (limiter.max_jobs, limiter.timespan) == _DEFAULT_JOB_RATE:
        scheduler.job_rate_limiter = None


_DEFAULT_JOB_RATE = (100, 1)


def stopped() -> None:
    """Say, after an error or Ctrl-C, what becomes of what was done; called as `start` is."""
    _print("what is finished is kept; the same command goes on from there")


def prepare(results: str | Path) -> None:
    """Delete what killed jobs were writing; raise an `OSError` if the results folder cannot be written."""
    results = Path(results)
    try:
        results.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=results):
            pass
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(results)) from error
    atomic.delete_abandoned(results)
