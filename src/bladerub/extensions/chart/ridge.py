"""The ridge of Y_k over E and K: where it runs, how high it is, and how far that depends on the speed step.

1. The ridge along E is, for each E, the K of the greatest Y_k; along K, for each K the E.
2. Its spread over neighbours is between the lowest and the highest Y_k of the cells around, eight or fewer.
3. Both are sought again among the runs at even speeds of two and four times the study's step: what the chart
   would say if nobody had looked between them.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from bladerub.extensions.chart.cell import Cell
from bladerub.extensions.chart.explanation import contact_stiffness
from bladerub.extensions.chart.grid import ORDERS
from bladerub.study.peaks import amplitude_in_window, maximum

MULTIPLES = (1, 2, 4)
"""Speed steps that are compared, in those of the study."""


def table(config: Mapping[str, Any], chart: Iterable[Cell]) -> pd.DataFrame:
    """Find the ridges.

    Parameters
    ----------
    config : mapping
        The study.
    chart : iterable of Cell
        The cells.

    Returns
    -------
    DataFrame
        A row for each cell on a ridge: ``casing, theta, order, along, speed_step, E, K, E_T, f_peak``,
        ``amplitude`` (m), and ``lowest_neighbour`` and ``highest_neighbour`` (m).
    """
    cells, rows = list(chart), []
    for multiple in MULTIPLES:
        peaks = _peaks(config, cells, multiple)
        for (casing, theta, order), over_moduli in peaks.groupby(["casing", "theta", "order"]):
            about = {"casing": casing, "theta": theta, "order": order}
            rows += [about | row for row in _ridge(over_moduli, config["speeds"]["step"] * multiple)]
    return pd.DataFrame(rows)


def _peaks(config: Mapping[str, Any], chart: list[Cell], multiple: int) -> pd.DataFrame:
    """Y_k of each cell from its runs at speeds `multiple` steps of the study apart; NaN without any."""
    rows = []
    for cell in chart:
        steps = (cell.f_omega - config["chart"]["speeds"]["start"]) / (config["speeds"]["step"] * multiple)
        even = np.abs(steps - np.rint(steps)) < 1e-6
        seen = cell if multiple == 1 else replace(cell, spectrum_amplitude=_only(even, cell))
        for order in ORDERS:
            found = maximum(seen, amplitude_in_window(seen, order, config["analysis"]["peaks"]))
            rows.append(
                {
                    "casing": cell.case.casing,
                    "theta": cell.case.theta,
                    "order": order,
                    "E": cell.case.E,
                    "K": cell.case.K,
                    "f_peak": found.f_omega,
                    "amplitude": found.amplitude,
                }
            )
    return pd.DataFrame(rows)


def _only(even: np.ndarray, cell: Cell) -> np.ndarray:
    return np.where(even[:, None], cell.spectrum_amplitude, np.nan)


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
        yield {
            "along": along,
            "speed_step": round(speed_step, 9),
            "E": E[i],
            "K": K[j],
            "E_T": contact_stiffness(E[i], K[j]),
            "f_peak": speed[i, j],
            "amplitude": Y[i, j],
            "lowest_neighbour": np.nanmin(around),
            "highest_neighbour": np.nanmax(around),
        }


def summary(ridges: pd.DataFrame) -> pd.DataFrame:
    """Sum up for each casing, θ and order how surely the ridge along E is known.

    Parameters
    ----------
    ridges : DataFrame
        From `table`.

    Returns
    -------
    DataFrame
        A row for each speed step: place and height of the highest cell on the ridge; ``lowest_E_T`` and
        ``highest_E_T`` of the ridge; medians over the ridge of ``neighbour_spread``, what lies between the
        neighbours over the height, of ``height_lost`` against the finest step, relative, and of ``K_shift``,
        the factor by which K of the ridge is off that of the finest step.
    """
    along = ridges[ridges.along == "E"]
    rows = []
    for (casing, theta, order), ridge in along.groupby(["casing", "theta", "order"]):
        finest = ridge[ridge.speed_step == ridge.speed_step.min()].set_index("E")
        for step, line in ridge.groupby("speed_step"):
            line, top = line.set_index("E"), line.loc[line.amplitude.idxmax()]
            spread = (line.highest_neighbour - line.lowest_neighbour) / line.amplitude
            rows.append(
                {
                    "casing": casing,
                    "theta": theta,
                    "order": order,
                    "speed_step": step,
                    **{name: top[name] for name in ("E", "K", "E_T", "f_peak", "amplitude")},
                    "lowest_E_T": line.E_T.min(),
                    "highest_E_T": line.E_T.max(),
                    "neighbour_spread": spread.median(),
                    "height_lost": (1 - line.amplitude / finest.amplitude).median(),
                    "K_shift": np.exp(np.abs(np.log(line.K / finest.K)).median()),
                }
            )
    return pd.DataFrame(rows)
