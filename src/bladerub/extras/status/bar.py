"""A bar on a terminal, while the runs of a coating are computed."""

import sys
from pathlib import Path
from typing import IO

from tqdm import tqdm

from bladerub.io import lock
from bladerub.study.job import RunDone


class Bar:
    """The bar of the coating `name`, if standard error is a terminal and no other job shows one there."""

    def __init__(self, name: str, folder: Path):
        self._name, self._turn = name, folder.with_name(".terminal.lock")
        self._lock: IO | None = None
        self._bar = tqdm(disable=True)

    def show(self, run: RunDone) -> None:
        """Show that one more run is done, with the estimated time left."""
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
        if self._bar.total != run.total or run.number <= self._bar.n:  # the longer runs are counted again
            self._bar.reset(run.total)
        # not tqdm's own estimate from the rate so far: slow speeds cost more, and come first
        self._bar.set_postfix_str(f"about {run.seconds_left:.0f} s left", refresh=False)
        self._bar.update(run.number - self._bar.n)

    def close(self) -> None:
        """Remove the bar."""
        self._bar.close()
        if self._lock:
            self._lock.close()
