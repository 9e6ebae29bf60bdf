"""The ridge of Y_k over E and K: where it lies, how high it is, and how far that depends on the speed step.

1. The ridge along E is, for each E, the K of the greatest Y_k; along K, for each K the E.
2. The neighbours of a point are the eight or fewer points around it.
3. Both are determined again from the runs at even speeds of two and four times the study's step: what the
   chart would show if it had no finer speeds.
"""

from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Any

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
    points, rows = list(points), []
    for multiple in MULTIPLES:
        for surface, peaks in _peaks(config, points, multiple).groupby(_SURFACE):
            about = dict(zip(_SURFACE, surface, strict=True))
            rows += [about | row for row in _ridge(peaks, config.speeds.step * multiple)]
    return pd.DataFrame(rows, columns=COLUMNS)


def _peaks(config: Config, points: list[ChartPoint], multiple: int) -> pd.DataFrame:
    """Y_k of each point from its runs at speeds `multiple` steps of the study apart; NaN without any."""
    rows = []
    for point in points:
        first = point.f_omega[np.abs(point.f_omega - config.chart.speeds.start).argmin()]
        steps = (point.f_omega - first) / (config.speeds.step * multiple)
        even = (np.abs(steps - np.rint(steps)) < 1e-6) | (multiple == 1)
        subset = replace(point, spectrum_amplitude=np.where(even[:, None], point.spectrum_amplitude, np.nan))
        case = point.case
        for order in chart_orders(config):
            peak = maximum(subset, amplitude_in_window(subset, order, config.analysis.peaks))
            rows.append((case.casing, case.theta, order, case.E, case.K, peak.f_omega, peak.amplitude))
    return pd.DataFrame(rows, columns=[*_SURFACE, "E", "K", "f_peak", "amplitude"])


def _ridge(peaks: pd.DataFrame, speed_step: float) -> Iterator[dict[str, Any]]:
    height = peaks.pivot(index="E", columns="K", values="amplitude")
    speed = peaks.pivot(index="E", columns="K", values="f_peak").to_numpy()
    E, K, Y = height.index.to_numpy(), height.columns.to_numpy(), height.to_numpy()
    highest = np.nan_to_num(Y, nan=-np.inf)
    places = [("E", i, int(j)) for i, j in enumerate(highest.argmax(axis=1))]
    places += [("K", int(i), j) for j, i in enumerate(highest.argmax(axis=0))]
    for along, i, j in places:
        if np.isnan(Y[i, j]):
            continue
        around = Y[max(i - 1, 0) : i + 2, max(j - 1, 0) : j + 2].copy()
        around[min(i, 1), min(j, 1)] = np.nan
        neighbours = pd.Series(around.ravel())
        yield {
            "along": along,
            "speed_step": round(speed_step, 9),
            "E": E[i],
            "K": K[j],
            "E_T": contact_stiffness(E[i], K[j]),
            "f_peak": speed[i, j],
            "amplitude": Y[i, j],
            "lowest_neighbour": neighbours.min(),
            "highest_neighbour": neighbours.max(),
        }


def summary(ridges: pd.DataFrame) -> pd.DataFrame:
    """Sum up for each casing, θ, order and speed step how certain the ridge along E of `table` is.

    Place and height of the highest point on the ridge; ``lowest_E_T`` and ``highest_E_T`` of the ridge;
    medians over the ridge of ``neighbour_spread``, the range of the neighbours over the height, of
    ``height_lost`` against the finest step, relative, and of ``K_shift``, the factor between K and that of
    the finest step.
    """
    rows = []
    for surface, ridge in ridges[ridges.along == "E"].groupby(_SURFACE):
        finest = ridge[ridge.speed_step == ridge.speed_step.min()].set_index("E")
        for step, line in ridge.groupby("speed_step"):
            line, top = line.set_index("E"), line.loc[line.amplitude.idxmax()]
            spread = (line.highest_neighbour - line.lowest_neighbour) / line.amplitude
            rows.append(
                {
                    **dict(zip(_SURFACE, surface, strict=True)),
                    "speed_step": step,
                    **{name: top[name] for name in ("E", "K", "E_T", "f_peak", "amplitude")},
                    "lowest_E_T": line.E_T.min(),
                    "highest_E_T": line.E_T.max(),
                    "neighbour_spread": spread.median(),
                    "height_lost": (1 - line.amplitude / finest.amplitude).median(),
                    "K_shift": np.exp(np.abs(np.log(line.K / finest.K)).median()),
                }
            )
    return pd.DataFrame(rows, columns=SUMMARY)
