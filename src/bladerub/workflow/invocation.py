"""What an invocation of the workflow does about those killed before it, so that it just goes on."""

from __future__ import annotations

import shutil
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import IO

from bladerub.extensions.chart.manifest import lost_cell
from bladerub.io import atomic, lock
from bladerub.io.errors import DamagedFile
from bladerub.study.store import lost_run


def begin(snakemake_folder: str | Path, results: str | Path) -> IO:
    """Clear away what keeps Snakemake from going on, before it plans.

    That is, first, the lock of a killed Snakemake: Snakemake notes in files which files it makes, and takes
    any such note for that of a living process, until somebody calls it with ``--unlock``. So each invocation
    also shares a lock that the kernel drops when its process dies, however it dies; if no other holds
    that one, there is nobody whose notes these could be, and they are deleted. If another does, nothing is
    deleted, and Snakemake itself decides by the notes whether the two get into each other's way. (Without
    Snakemake's own lock, its ``nolock``, two invocations would delete each other's files.)

    Second, the manifest of a coating that lists a run which is lost or of another size, and that of a column
    of the chart with such a cell: without its manifest the job is planned again, and computes that alone.

    Parameters
    ----------
    snakemake_folder : path-like
        ``.snakemake`` of the working directory.
    results : path-like
        The results folder.

    Returns
    -------
    stream
        To be kept open as long as the invocation lives.

    Raises
    ------
    OSError
        If one of the folders cannot be written.
    """
    locks = Path(snakemake_folder) / "locks"
    stream, alone = lock.share(Path(snakemake_folder) / "bladerub.lock")
    if not alone:
        _tell("another snakemake is at work in this folder; if it keeps this one out, wait for its end")
    elif any(locks.glob("*.lock")):
        shutil.rmtree(locks)
        _tell("the last snakemake here was killed; what it had finished is kept")
    for pattern, lost_file in (("runs/*/manifest.tsv", lost_run), ("chart/columns/*.tsv", lost_cell)):
        for manifest in sorted(Path(results).glob(pattern)):
            _forget_if_wrong(manifest, lost_file)
    return stream


def _forget_if_wrong(manifest: Path, lost_file: Callable[[Path], str | None]) -> None:
    try:
        lost = lost_file(manifest)
    except DamagedFile as error:
        fault = str(error)
    else:
        if lost is None:
            return
        fault = f"{lost}: missing, or not as long as it was written"
    manifest.unlink(missing_ok=True)
    _tell(f"{fault}; its coating is planned again and computes only what is not there")


def _tell(line: str) -> None:
    print(f"bladerub: {line}", file=sys.stderr)


def prepare(results: str | Path) -> None:
    """Make sure that the results folder can be written, and delete what killed jobs were writing.

    Raises
    ------
    OSError
        If it cannot be written; ``filename`` is the folder.
    """
    results = Path(results)
    try:
        results.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=results):
            pass
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(results)) from error
    atomic.delete_abandoned(results)
