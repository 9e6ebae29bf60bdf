"""Engine orders of the chart, and speeds at which each of its coatings may be run, and is run first."""

from typing import NamedTuple

import numpy as np

from bladerub.io.errors import BadInput
from bladerub.settings.study import Config
from bladerub.study.grid import speeds
from bladerub.study.orders import peak_orders


def chart_orders(config: Config) -> list[int]:
    """Return the engine orders of the chart, those of its casing: 4 and 6 in the paper's Figs. 11 to 14."""
    return peak_orders(config, config.chart.casing)


class ChartSpeeds(NamedTuple):
    """Speeds at which a point may be run, and those at which every point is."""

    f_omega: np.ndarray  # (n,), all speeds of the study, normalised: a run of the chart is one of the study's
    uniform: np.ndarray  # (n,) of bool, at even steps, to which the shares of the chart refer
    coarse: np.ndarray  # (n,) of bool, these and denser ones at low speed: where the search for maxima begins


def nearest_speeds(config: Config, multiple: int = 1) -> ChartSpeeds:
    """Choose the speeds of the study that are nearest to the even ones of ``chart.speeds``.

    The even ones are `multiple` times as far apart as the config says.
    """
    f_omega, settings = np.array(speeds(config)), config.chart.speeds
    start, stop, dense_stop = settings.start, f_omega[-1], min(settings.dense_stop, f_omega[-1])
    uniform = _nearest(f_omega, np.arange(start, stop + 1e-9, multiple * settings.step))
    dense = _nearest(f_omega, np.arange(start, dense_stop + 1e-9, multiple * settings.dense_step))
    return ChartSpeeds(f_omega, uniform, uniform | dense)


def _nearest(f_omega: np.ndarray, even: np.ndarray) -> np.ndarray:
    mask = np.zeros(f_omega.size, dtype=bool)
    mask[np.abs(f_omega - even[:, None]).argmin(axis=1)] = True
    return mask


def check(config: Config) -> None:
    """Raise `BadInput`, naming the key, if the chart has no speeds, or an engine order no crossing with C1.

    Studies without a chart need neither.
    """
    highest, lowest = config.speeds.stop, min(chart_orders(config))
    if (start := config.chart.speeds.start) >= highest:
        raise BadInput(f"chart.speeds.start = {start:g}: must be below speeds.stop = {highest:g}")
    if lowest * highest < 1:  # rotation stiffens the blade: C1 is nowhere below its value at rest, 1
        raise BadInput(
            f"speeds.stop = {highest:g}: must be at least {1 / lowest:g} for the chart, or engine order "
            f"{lowest} does not cross the first frequency"
        )
