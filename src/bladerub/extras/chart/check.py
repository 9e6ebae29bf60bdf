"""How well the search for maxima does, tried on the maps of the study, which has every speed."""

from collections.abc import Iterable

import numpy as np
import pandas as pd

from bladerub.extras.chart.plan import chart_speeds
from bladerub.extras.chart.search import next_speeds, sought
from bladerub.extras.chart.table import COATING
from bladerub.settings.study import Config
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import maximum


def table(config: Config, maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Compare what the search finds on each coating of the study with what is there.

    A row per coating and ``quantity`` (each Y_k, and peak): ``found`` at ``f_found`` by the search,
    ``greatest`` at ``f_greatest`` among all speeds, both in m, and ``missed = 1 - found / greatest``.
    """
    speeds, share = chart_speeds(config), config.chart.speeds.refine_above
    rows = []
    for coating in maps:
        curves = sought(config, coating, np.nanmax(coating.revolution_peak, axis=1))
        computed = speeds.coarse.copy()
        while pending := next_speeds(computed, curves.values(), share):
            computed[pending] = True
        for quantity, curve in curves.items():
            highest, peak = maximum(coating, np.where(computed, curve, np.nan)), maximum(coating, curve)
            if np.isnan(highest.amplitude):
                continue  # no run with a spectrum, so nothing to find
            rows.append(
                {name: getattr(coating.case, name) for name in COATING}
                | {"quantity": quantity, "found": highest.amplitude, "f_found": highest.f_omega}
                | {"greatest": peak.amplitude, "f_greatest": peak.f_omega}
                | {"missed": 1 - highest.amplitude / peak.amplitude}
            )
    return pd.DataFrame(rows)


def summary(compared: pd.DataFrame) -> pd.DataFrame:
    """Count, for each quantity, the coatings found exactly, to 1 % and to 5 %, and the worst miss."""
    missed = compared.groupby("quantity").missed
    counted = missed.agg(
        coatings="size",
        exact=lambda misses: (misses == 0).sum(),
        within_1_percent=lambda misses: (misses <= 0.01).sum(),
        within_5_percent=lambda misses: (misses <= 0.05).sum(),
        worst_missed="max",
    )
    return counted.reset_index()


def agreement(chart: pd.DataFrame, compared: pd.DataFrame) -> pd.DataFrame:
    """Compare those points of the chart that are coatings of the study with what the search finds there.

    The rows of `compared` that are points, with ``in_chart`` (m) and its relative ``disagreement`` with
    ``found``: 0 where the runs are the same.
    """
    quantities = [name for name in chart.columns if name in set(compared.quantity)]
    values = chart.melt(COATING, quantities, "quantity", "in_chart")
    both = compared.merge(values, on=[*COATING, "quantity"])
    return both.assign(disagreement=both.in_chart / both.found - 1)
