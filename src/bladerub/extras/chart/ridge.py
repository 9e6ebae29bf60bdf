"""The ridge of Y_k over E and K: where it lies, how high it is, and how far that depends on the speed step.

1. The ridge along E is, for each E, the K of the greatest Y_k; along K, for each K the E.
2. The neighbours of a point are the eight or fewer points around it.
3. Both are determined again from the runs at even speeds of two and four times the study's step: what the
   chart would show if it had no finer speeds.
"""

from collections.abc import Iterable
from dataclasses import replace

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
