"""The ridge of Y_k over E and K: where it lies, how high it is, and how far that depends on the speed step.

1. The ridge along E is, for each E, the K of the greatest Y_k; along K, for each K the E.
2. The neighbours of a point are the eight or fewer points around it.
3. Both are determined again from the runs at even speeds of two and four times the study's step: what the
   chart would show if it had no finer speeds.
"""

from collections.abc import Iterable

import numpy as np
import pandas as pd

from bladerub.extras.chart.point import ChartPoint, chart_orders
from bladerub.extras.chart.stiffening import contact_stiffness
from bladerub.settings.study import Config
from bladerub.study.peaks import amplitude_in_window, maximum

MULTIPLES = (1, 2, 4)
"""Speed steps that are compared, in those of the study."""

_SURFACE = ["casing", "theta", "order"]

COLUMNS = [
    *(*_SURFACE, "along", "speed_step", "E", "K", "E_T", "f_peak", "amplitude"),
    *("lowest_neighbour", "highest_neighbour"),
]
"""Columns of ``chart_ridge.csv``."""
SUMMARY = [
    *(*_SURFACE, "speed_step", "E", "K", "E_T", "f_peak", "amplitude", "lowest_E_T", "highest_E_T"),
    *("neighbour_spread", "height_lost", "K_shift"),
]
"""Columns of ``chart_ridge_summary.csv``."""


def table(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Find the ridges.

    A row with `COLUMNS`, m, for each point on a ridge; NaN for the neighbours if none of them has a peak.
    """
    points, ridges = list(points), []
    for multiple in MULTIPLES:
        peaks = _peaks(config, points, multiple).assign(speed_step=round(config.speeds.step * multiple, 9))
        ridges += [_ridge(of_surface) for _, of_surface in peaks.groupby(_SURFACE)]
    return pd.concat(ridges, ignore_index=True)[COLUMNS]


def _peaks(config: Config, points: list[ChartPoint], multiple: int) -> pd.DataFrame:
    """Y_k of each point from its runs at speeds `multiple` steps of the study apart; NaN without any."""
    rows, settings = [], config.analysis.peaks
    for point in points:
        first = point.f_omega[np.abs(point.f_omega - config.chart.speeds.start).argmin()]
        steps = (point.f_omega - first) / (config.speeds.step * multiple)
        even = (np.abs(steps - np.rint(steps)) < 1e-6) | (multiple == 1)
        case = point.case
        for order in chart_orders(config):
            peak = maximum(point, np.where(even, amplitude_in_window(point, order, settings), np.nan))
            rows.append((case.casing, case.theta, order, case.E, case.K, peak.f_omega, peak.amplitude))
    return pd.DataFrame(rows, columns=[*_SURFACE, "E", "K", "f_peak", "amplitude"])


def _ridge(peaks: pd.DataFrame) -> pd.DataFrame:
    """Find both ridges of one surface, each in the order of its modulus; of equals the lowest modulus."""
    height = peaks.pivot(index="E", columns="K", values="amplitude")
    bordered = np.pad(height.to_numpy(), 1, constant_values=np.nan)
    peaks = peaks.dropna(subset="amplitude").sort_values(["E", "K"])
    ridge = pd.concat(
        peaks.loc[peaks.groupby(along).amplitude.idxmax()].assign(along=along) for along in ("E", "K")
    )
    places = zip(height.index.get_indexer(ridge.E), height.columns.get_indexer(ridge.K), strict=True)
    around = pd.DataFrame([np.delete(bordered[i : i + 3, j : j + 3], 4) for i, j in places])
    return ridge.assign(
        E_T=contact_stiffness(ridge.E, ridge.K),
        lowest_neighbour=around.min(axis=1).to_numpy(),
        highest_neighbour=around.max(axis=1).to_numpy(),
    )


def summary(ridges: pd.DataFrame) -> pd.DataFrame:
    """Sum up for each casing, θ, order and speed step how certain the ridge along E of `table` is.

    A row each, with `SUMMARY`: the highest point on the ridge, and medians over the ridge.
    """
    along_E, line = ridges[ridges.along == "E"], [*_SURFACE, "speed_step"]
    finest = along_E[along_E.speed_step == along_E.speed_step.min()]
    along_E = along_E.merge(finest, "left", on=[*_SURFACE, "E"], suffixes=("", "_finest"))
    along_E["neighbour_spread"] = (along_E.highest_neighbour - along_E.lowest_neighbour) / along_E.amplitude
    along_E["height_lost"] = 1 - along_E.amplitude / along_E.amplitude_finest
    along_E["K_shift"] = np.abs(np.log(along_E.K / along_E.K_finest))
    lines = along_E.groupby(line)
    summed = lines[["neighbour_spread", "height_lost", "K_shift"]].median()
    summed["K_shift"] = np.exp(summed["K_shift"])
    summed[["lowest_E_T", "highest_E_T"]] = lines.E_T.agg(["min", "max"])
    highest = along_E.loc[lines.amplitude.idxmax(), [*line, "E", "K", "E_T", "f_peak", "amplitude"]]
    return highest.merge(summed, on=line)[SUMMARY]
