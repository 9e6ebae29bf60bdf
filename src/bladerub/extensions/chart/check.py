"""How well the search for maxima does: put to the maps of the study, which knows every speed."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bladerub.extensions.chart.cell import Cell
from bladerub.extensions.chart.grid import ORDERS, chart_speeds
from bladerub.extensions.chart.search import empty, fill, sought
from bladerub.extensions.chart.table import CELL
from bladerub.study.maps import CoatingMap, read_map
from bladerub.study.peaks import order_amplitude


def table(config: Mapping[str, Any], map_paths: Iterable[str | Path]) -> pd.DataFrame:
    """Compare what the search finds on each coating of the study with what is there: `of_maps` on files."""
    return of_maps(config, map(read_map, map_paths))


def of_maps(config: Mapping[str, Any], maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Compare what the search finds on each coating of the study with what is there.

    Parameters
    ----------
    config : mapping
        The study.
    maps : iterable of CoatingMap
        Coatings at all speeds.

    Returns
    -------
    DataFrame
        A row per coating and ``quantity`` (Y4, Y6 or peak): ``found`` at ``f_found`` by the search,
        ``greatest`` at ``f_greatest`` among all speeds, both in m, and ``missed``: what the one lacks of the
        other, relative.
    """
    rows = []
    for coating in maps:
        everything = _whole(config, coating)
        searched = _searched(config, everything)
        about = {name: getattr(coating.case, name) for name in CELL}
        there = sought(everything, config)
        for quantity, found in sought(searched, config).items():
            at, truth = int(np.nanargmax(found)), int(np.nanargmax(there[quantity]))
            rows.append(
                about
                | {
                    "quantity": quantity,
                    "found": found[at],
                    "f_found": coating.f_omega[at],
                    "greatest": there[quantity][truth],
                    "f_greatest": coating.f_omega[truth],
                    "missed": 1 - found[at] / there[quantity][truth],
                }
            )
    return pd.DataFrame(rows)


def summary(compared: pd.DataFrame) -> pd.DataFrame:
    """Count, for each quantity, the coatings found exactly, to 1 % and to 5 %, and the worst miss."""
    missed = compared.groupby("quantity").missed
    return pd.DataFrame(
        {
            "coatings": missed.size(),
            "exact": missed.apply(lambda each: int((each == 0).sum())),
            "within_1_percent": missed.apply(lambda each: int((each <= 0.01).sum())),
            "within_5_percent": missed.apply(lambda each: int((each <= 0.05).sum())),
            "worst_missed": missed.max(),
        }
    ).reset_index()


def agreement(chart: pd.DataFrame, compared: pd.DataFrame) -> pd.DataFrame:
    """Compare the cells of the chart that the study has as well with what the search finds in the study.

    Returns
    -------
    DataFrame
        The rows of `compared` that are cells, with ``in_chart`` (m) and its ``disagreement`` with ``found``,
        relative: 0 where the runs are the same.
    """
    wide = chart.melt(CELL, [*(f"Y{order}" for order in ORDERS), "peak"], "quantity", "in_chart")
    both = compared.merge(wide, on=[*CELL, "quantity"])
    return both.assign(disagreement=both.in_chart / both.found - 1)


def _whole(config: Mapping[str, Any], coating: CoatingMap) -> Cell:
    """Take the coating for a cell that was run at all speeds, with what the search looks at."""
    cell = empty(coating.case, chart_speeds(config), coating.C1)
    halfwidth = config["analysis"]["peaks"]["order_halfwidth"]
    on_orders = [order_amplitude(coating, order, halfwidth) for order in ORDERS]
    peak = np.nanmax(coating.revolution_peak, axis=1)
    return replace(
        cell, spectrum_amplitude=np.stack(on_orders, axis=1), measures=cell.measures | {"peak": peak}
    )


def _searched(config: Mapping[str, Any], everything: Cell) -> Cell:
    speeds = chart_speeds(config)
    cell = empty(everything.case, speeds, everything.C1)

    def take(index: int) -> None:
        cell.spectrum_amplitude[index] = everything.spectrum_amplitude[index]
        cell.measures["peak"][index] = everything.measures["peak"][index]

    fill(cell, config, speeds, take)
    return cell
