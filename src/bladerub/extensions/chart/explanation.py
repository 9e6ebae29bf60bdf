"""What goes with the height of a peak: stiffness of the contact, energy dissipated in a cycle, worn lobes."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import pandas as pd

from bladerub.extensions.chart.cell import Cell
from bladerub.extensions.chart.grid import ORDERS
from bladerub.extensions.chart.table import CELL
from bladerub.study.peaks import crossing_speed, peak

LOSSES = ("wear", "sliding", "damping")
"""Where the energy goes: into the coating, into its tangential resistance, into the blade's own damping."""


def contact_stiffness(E: float, K: float) -> float:
    """Tangent modulus of the coating while it wears, E_T = E K / (E + K): both moduli in series."""
    return E * K / (E + K)


def table(config: Mapping[str, Any], chart: Iterable[Cell]) -> pd.DataFrame:
    """Look at the run at the peak of each engine order.

    Returns
    -------
    DataFrame
        A row per cell and order: `bladerub.extensions.chart.table.CELL`, ``order``, ``E_T``, ``f_crossing``,
        ``f_peak``, ``amplitude`` (m), ``lobes`` and each of `LOSSES` as ``<loss>_per_cycle`` (J): the mean
        over the run, in which a vibration on the order k has k cycles a revolution.

    Raises
    ------
    ValueError
        As `bladerub.study.peaks.peak`.
    """
    rows = []
    for cell in chart:
        for order in ORDERS:
            found = peak(cell, order, config["analysis"]["peaks"])
            at = int(np.flatnonzero(cell.f_omega == found.f_omega)[0])
            cycles = order * cell.measures["revolutions"][at]
            rows.append(
                {name: getattr(cell.case, name) for name in CELL}
                | {
                    "order": order,
                    "E_T": contact_stiffness(cell.case.E, cell.case.K),
                    "f_crossing": crossing_speed(cell, order),
                    "f_peak": found.f_omega,
                    "amplitude": found.amplitude,
                    "lobes": int(cell.measures["lobes"][at]),
                }
                | {f"{loss}_per_cycle": cell.measures[f"energy_{loss}"][at] / cycles for loss in LOSSES}
            )
    return pd.DataFrame(rows)
