"""The chart as a table, a row for each point."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.extras.chart import point as files
from bladerub.extras.chart.point import ChartPoint, PointRow, chart_orders
from bladerub.io.errors import DamagedFile
from bladerub.settings.study import Config
from bladerub.study.manifest import listed_files
from bladerub.study.peaks import peak

COATING = ["casing", "E", "K", "theta"]
"""Columns that identify the coating of a row."""


def read_points(manifests: Iterable[str | Path]) -> Iterator[ChartPoint]:
    """Read the points that the manifests of the columns list.

    Raises `OSError`, naming the file, if one is missing, damaged or not the one that its manifest lists.
    """
    for path in manifests:
        for file in listed_files(path, PointRow):
            if file.is_damaged():
                raise DamagedFile(f"{file.path}: not the point of the chart that {path} lists")
            yield files.read(file.path)


def table(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Sum up every point.

    A row per point: `COATING`, Y_k and f_k for each engine order of the chart, the greatest of the measures
    over the speeds, shares of the uniform speeds, and the number of runs. A missing peak is NaN.
    """
    rows, orders = [], chart_orders(config)
    for point in points:
        measures, row = point.measures, {name: getattr(point.case, name) for name in COATING}
        for order in orders:
            speed, amplitude, _ = peak(point, order, config.analysis.peaks)
            row |= {f"Y{order}": amplitude, f"f{order}": speed}
        highest = int(np.nanargmax(measures["peak"]))
        row |= {"peak": measures["peak"][highest], "f_at_peak": point.f_omega[highest]}
        row |= {name: np.nanmax(measures[name]) for name in ("worn_volume", "deepest_wear")}
        for name in ("divergent", "unbounded"):
            row[f"{name}_share"] = np.mean(measures[name][point.uniform])
        rows.append(row | {"runs": int(point.known.sum())})
    return pd.DataFrame(rows)
