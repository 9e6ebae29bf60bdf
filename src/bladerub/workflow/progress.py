"""What a coating's job reports while it runs: its log, and one line at the end."""

import time
from collections.abc import Sequence
from pathlib import Path

from bladerub import plugins
from bladerub.study.job import RunDone
from bladerub.study.manifest import ManifestRow
from bladerub.workflow import job


class JobProgress:
    """Report of `bladerub.study.job.compute_missing` on the coating `name`, called with each finished run.

    The log of the job takes a line for each run, which is in `folder`, with the estimated time left; what
    plugs in (``BARS``) shows it elsewhere.
    """

    def __init__(self, name: str, folder: Path):
        self._name, self._computed, self._start = name, 0, time.monotonic()
        self._bars = [bar(name, folder) for bar in plugins.loaded("BARS").values()]

    def __call__(self, event: RunDone | str) -> None:
        """Report one computed run, or what the job waits for."""
        job.log(event)
        if isinstance(event, RunDone):
            self._computed += 1
            for bar in self._bars:
                bar.show(event)

    def finish(self, rows: Sequence[ManifestRow]) -> None:
        """Sum up in the log and on standard output what `compute_missing` returned."""
        for bar in self._bars:
            bar.close()
        longer = sum(bool(row.confirmation_key) for row in rows)
        unbounded = sum(row.status == "unbounded" for row in rows)
        summary = (
            f"{self._name}: {len(rows)} runs, {unbounded} of them unbounded, {longer} followed further; "
            f"{self._computed} computed in {time.monotonic() - self._start:.0f} s"
        )
        job.log(summary)
        print(summary)
