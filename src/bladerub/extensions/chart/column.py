"""The job of one column of the chart: every cell that is missing or stale, each written when it is done."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade
from bladerub.extensions.chart import point as points
from bladerub.extensions.chart.grid import chart_speeds
from bladerub.extensions.chart.key import cell_key
from bladerub.extensions.chart.manifest import CellRow, is_current
from bladerub.extensions.chart.search import compute
from bladerub.io import lock
from bladerub.study.grid import CoatingCase


def compute_missing(
    config: Mapping[str, Any],
    cases: Sequence[CoatingCase],
    blade: ReducedBlade,
    folder: str | Path,
    blade_digest: str,
    report: Callable[[str], None],
) -> list[CellRow]:
    """Compute those cells of a column whose file is missing or stale.

    Cells that are no longer asked for are left where they are. One job at a time works on a column, as for
    the runs of a coating (`bladerub.study.job`).

    Parameters
    ----------
    config : mapping
        The study.
    cases : sequence of CoatingCase
        The coatings of the column, of one casing, E and θ.
    blade : ReducedBlade
        The blade.
    folder : path-like
        Where the cells of the whole chart live.
    blade_digest : str
        From `bladerub.study.key.blade_digest`.
    report : callable
        Called with a line for a log after each computed cell, and before waiting.

    Returns
    -------
    list of CellRow
        A row per coating, for `bladerub.extensions.chart.manifest.write`.
    """
    folder, speeds = Path(folder), chart_speeds(config)
    first = cases[0]
    column_lock = folder / f".{first.casing}_E{first.E:g}_theta{first.theta:g}.lock"
    with lock.held(column_lock, lambda: report("another job is at work on this column: waiting for its end")):
        keys = {case: cell_key(config, case, speeds, blade_digest) for case in cases}
        missing = [case for case in cases if not is_current(_path(folder, case), keys[case])]
        if missing:
            C1 = np.array([reduced_frequencies(blade, f, n_modes=1)[0] for f in speeds.f_omega]) / blade.f1_hz
        for number, case in enumerate(missing, 1):
            start = time.monotonic()
            point = compute(config, case, blade, speeds, C1)
            points.write(_path(folder, case), point, keys[case], config)
            report(
                f"[{number}/{len(missing)}] {case.name}: {point.known.sum()} runs in "
                f"{time.monotonic() - start:.1f} s"
            )
        return [_row(_path(folder, case), keys[case]) for case in cases]


def _row(path: Path, key: str) -> CellRow:
    return CellRow(path.name, key, path.stat().st_size)


def _path(folder: Path, case: CoatingCase) -> Path:
    return folder / f"{case.name}.h5"
