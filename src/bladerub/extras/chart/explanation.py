"""What goes with the height of a peak: stiffness of the contact, energy dissipated in a cycle, worn lobes."""

import itertools
from collections.abc import Iterable

import numpy as np
import pandas as pd

from bladerub.extras.chart.grid import chart_orders
from bladerub.extras.chart.point import ChartPoint
from bladerub.extras.chart.table import COATING
from bladerub.settings.study import Config
from bladerub.study.peaks import crossing_speed, row

LOSSES = ("wear", "sliding", "damping")
"""Where the energy goes: wear of the coating, its tangential resistance, damping of the blade."""

COLUMNS = [
    *(*COATING, "order", "E_T", "f_crossing", "f_peak", "amplitude", "lobes"),
    *(f"{loss}_per_cycle" for loss in LOSSES),
]
"""Columns of ``chart_explanation.csv``."""


def contact_stiffness(E: float, K: float) -> float:
    """Tangent modulus of the coating while it wears, E_T = E K / (E + K): both moduli in series."""
    return E * K / (E + K)


def table(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Look at the run at the peak of each engine order.

    A row per point and order: `COATING`, ``order``, ``E_T``, ``f_crossing``, ``f_peak``, ``amplitude`` (m),
    ``lobes`` and each of `LOSSES` as ``<loss>_per_cycle`` (J), the mean over the run, in which a vibration on
    the order k has k cycles per revolution. Without a peak all but ``E_T`` and ``f_crossing`` is NaN.
    """
    rows = []
    for point, order in itertools.product(points, chart_orders(config)):
        about = row(point, order, config.analysis.peaks) | {
            "E_T": contact_stiffness(point.case.E, point.case.K),
            "f_crossing": crossing_speed(point, order),
        }
        rows.append(about)
        if about["reason"]:
            continue  # no peak to look at
        index = int(np.flatnonzero(point.f_omega == about["f_peak"])[0])
        cycles = order * point.measures["revolutions"][index]
        about["lobes"] = int(point.measures["lobes"][index])
        about |= {f"{loss}_per_cycle": point.measures[f"energy_{loss}"][index] / cycles for loss in LOSSES}
    return pd.DataFrame(rows, columns=COLUMNS)
