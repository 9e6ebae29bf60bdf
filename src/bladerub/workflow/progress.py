"""What a coating's job reports while it runs: its log, a bar on a terminal, and one line at the end."""

import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import IO, TextIO

from tqdm import tqdm

from bladerub.io import lock
from bladerub.study.job import RunDone
from bladerub.study.manifest import ManifestRow


class JobProgress:
    """Report of `bladerub.study.job.compute_missing` on the coating `name`, called with each finished run.

    `log` takes a line for each run, with the estimated time left; `terminal` takes a bar while the job runs,
    if it is a terminal and no other job holds the lock file `turn`: two bars would overwrite each other.
    """

    def __init__(self, name: str, log: TextIO, terminal: TextIO, turn: str | Path):
        self._name, self._log, self._terminal, self._turn = name, log, terminal, turn
        self._lock: IO | None = None
        self._bar = tqdm(disable=True)
        self._computed, self._start = 0, time.monotonic()

    def __call__(self, event: RunDone | str) -> None:
        """Report one computed run, or what the job waits for."""
        print(event, file=self._log)
        if isinstance(event, str):
            return
        self._computed += 1
        if self._bar.disable and self._terminal.isatty():
            self._take_turn()
        if self._bar.total != event.total or event.number <= self._bar.n:  # the longer runs are counted again
            self._bar.reset(event.total)
        # not tqdm's own estimate from the rate so far: slow speeds cost more, and come first
        self._bar.set_postfix_str(f"about {event.seconds_left:.0f} s left", refresh=False)
        self._bar.update(event.number - self._bar.n)

    def _take_turn(self) -> None:
        self._lock = lock.attempt(self._turn)
        if self._lock:
            self._bar = tqdm(
                desc=self._name,
                bar_format="{desc}: {n_fmt}/{total_fmt} |{bar}|{postfix}",
                file=self._terminal,
                leave=False,
                dynamic_ncols=True,
            )

    def finish(self, rows: Sequence[ManifestRow]) -> None:
        """Write the `summary` to the log and to standard output."""
        summary = self.summary(rows)
        print(summary, file=self._log)
        print(summary)

    def summary(self, rows: Sequence[ManifestRow]) -> str:
        """Close the bar and sum up in one line what `compute_missing` returned."""
        self._bar.close()
        if self._lock:
            self._lock.close()
        longer = sum(bool(row.confirmation_key) for row in rows)
        unbounded = sum(row.status == "unbounded" for row in rows)
        return (
            f"{self._name}: {len(rows)} runs, {longer} of them longer as well, {unbounded} unbounded; "
            f"{self._computed} computed in {time.monotonic() - self._start:.0f} s"
        )


def of_job(name: str, folder: Path) -> JobProgress:
    """Report on the job of a coating, whose runs are in `folder`, to its log and to the terminal."""
    turn = folder.with_name(".terminal.lock")  # one for all coatings
    return JobProgress(name, log=sys.stderr, terminal=sys.__stderr__, turn=turn)
