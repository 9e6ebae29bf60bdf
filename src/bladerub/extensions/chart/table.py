"""The chart as a table: a row for each cell."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bladerub.extensions.chart import cell as cells
from bladerub.extensions.chart import manifest
from bladerub.extensions.chart.cell import Cell
from bladerub.extensions.chart.grid import ORDERS
from bladerub.io.errors import DamagedFile
from bladerub.study.peaks import peak

CELL = ["casing", "E", "K", "theta"]
"""Columns that tell the cells apart."""


def read_cells(manifests: Iterable[str | Path]) -> Iterator[Cell]:
    """Read the cells that the manifests of the columns list.

    Raises
    ------
    OSError
        If one is missing, damaged or another than its manifest says; the message names it.
    """
    for path in manifests:
        for row in manifest.read(path):
            file = manifest.cell_path(path, row)
            if not manifest.is_current(file, row.cell_key):
                raise DamagedFile(f"{file}: not the cell that {path} lists")
            yield cells.read(file)


def table(config: Mapping[str, Any], chart: Iterable[Cell]) -> pd.DataFrame:
    """Sum up every cell.

    Parameters
    ----------
    config : mapping
        ``analysis.peaks`` has the windows.
    chart : iterable of Cell
        The cells.

    Returns
    -------
    DataFrame
        A row a cell: `CELL`, Y_k in m and f_k for each engine order of the chart, the greatest displacement
        ``peak`` and its speed, the greatest worn volume and depth over the speeds, the shares of the uniform
        speeds that diverge and that leave all bounds, and the number of runs.

    Raises
    ------
    ValueError
        As `bladerub.study.peaks.peak`.
    """
    return pd.DataFrame([_row(config["analysis"]["peaks"], cell) for cell in chart])


def _row(settings: Mapping[str, Any], cell: Cell) -> dict[str, Any]:
    measures, row = cell.measures, {name: getattr(cell.case, name) for name in CELL}
    for order in ORDERS:
        found = peak(cell, order, settings)
        row |= {f"Y{order}": found.amplitude, f"f{order}": found.f_omega}
    highest = int(np.nanargmax(measures["peak"]))
    return row | {
        "peak": measures["peak"][highest],
        "f_at_peak": cell.f_omega[highest],
        "worn_volume": np.nanmax(measures["worn_volume"]),
        "deepest_wear": np.nanmax(measures["deepest_wear"]),
        "divergent_share": np.mean(measures["divergent"][cell.uniform]),
        "unbounded_share": np.mean(measures["unbounded"][cell.uniform]),
        "runs": int(cell.known.sum()),
    }
