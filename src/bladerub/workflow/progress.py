"""What a coating's job reports while it runs: its log, a bar on a terminal, and one line at the end."""

import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import IO

from tqdm import tqdm

from bladerub.io import lock
from bladerub.study.job import RunDone
from bladerub.study.manifest import ManifestRow
from bladerub.workflow import job


class JobProgress:
    """Report of `bladerub.study.job.compute_missing` on the coating `name`, called with each finished run.

    The log of the job takes a line for each run, which is in `folder`, with the estimated time left; the
    former standard error takes a bar while the job runs, if it is a terminal and no other job holds the lock
    file of all coatings: two bars would overwrite each other.
    """

    def __init__(self, name: str, folder: Path):
        self._name, self._turn = name, folder.with_name(".terminal.lock")
        self._lock: IO | None = None
        self._bar = tqdm(disable=True)
        self._computed, self._start = 0, time.monotonic()

    def __call__(self, event: RunDone | str) -> None:
        """Report one computed run, or what the job waits for."""
        job.log(event)
        if isinstance(event, str):
            return
        self._computed += 1
        if self._bar.disable and sys.__stderr__.isatty():
            self._lock = lock.attempt(self._turn)
            if self._lock:
                self._bar = tqdm(
                    desc=self._name,
                    bar_format="{desc}: {n_fmt}/{total_fmt} |{bar}|{postfix}",
                    file=sys.__stderr__,
                    leave=False,
                    dynamic_ncols=True,
                )
        if self._bar.total != event.total or event.number <= self._bar.n:  # the longer runs are counted again
            self._bar.reset(event.total)
        # not tqdm's own estimate from the rate so far: slow speeds cost more, and come first
        self._bar.set_postfix_str(f"about {event.seconds_left:.0f} s left", refresh=False)
        self._bar.update(event.number - self._bar.n)

    def finish(self, rows: Sequence[ManifestRow]) -> None:
        """Close the bar; sum up in the log and on standard output what `compute_missing` returned."""
        self._bar.close()
        if self._lock:
            self._lock.close()
        longer = sum(bool(row.confirmation_key) for row in rows)
        unbounded = sum(row.status == "unbounded" for row in rows)
        summary = (
            f"{self._name}: {len(rows)} runs, {unbounded} of them unbounded, {longer} followed further; "
            f"{self._computed} computed in {time.monotonic() - self._start:.0f} s"
        )
        job.log(summary)
        print(summary)
