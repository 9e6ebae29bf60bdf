"""What the claims are measured on: the tables and maps of a study, and nothing else."""

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.io import tables
from bladerub.settings.study import Config
from bladerub.study.findings.claim import NotMeasurable
from bladerub.study.grid import SAME_SPEED, CoatingCase
from bladerub.study.maps import CoatingMap
from bladerub.study.variants import of_case, plain


class Evidence:
    """Maps of the coatings of one study, and its tables ``rom_accuracy``, ``peaks`` and ``divergence``."""

    def __init__(self, config: Config, tables: Mapping[str, pd.DataFrame], maps: Iterable[CoatingMap]):
        self.config = config
        self.rom_accuracy = tables["rom_accuracy"]
        self.peaks = plain(tables["peaks"])  # the paper has no variants
        self.divergence = plain(tables["divergence"])
        self._maps = {coating.case: coating for coating in maps}

    # Each of these raises `NotMeasurable` where the study has nothing to return.

    def map(self, case: CoatingCase) -> CoatingMap:
        """Return the map of a coating."""
        if case not in self._maps:
            raise NotMeasurable(f"coating {case.name} is not in the study")
        return self._maps[case]

    def peak(self, case: CoatingCase, order: int, column: str) -> float:
        """Return ``f_peak`` or ``amplitude`` (m) of one coating and engine order from the table of peaks."""
        rows = of_case(self.peaks, case)
        rows = rows[rows.order == order]
        if rows.empty:
            raise NotMeasurable(f"no peak of engine order {order} for coating {case.name}")
        value = float(rows[column].iloc[0])
        if np.isnan(value):
            why = rows["reason"].iloc[0] if "reason" in rows else "it is empty in peaks.csv"
            raise NotMeasurable(f"no peak of engine order {order} for coating {case.name}: {why}")
        return value

    def moduli(self, casing: str, theta: float, order: int, column: str) -> pd.DataFrame:
        """Return ``f_peak`` or ``amplitude`` (m) over K (rows) and E (columns), both ascending and finite."""
        peaks = self.peaks
        selection = (peaks.casing == casing) & (peaks.theta == theta) & (peaks.order == order)
        rows = peaks[selection & (peaks.law == "theta")]
        table = rows.pivot_table(index="K", columns="E", values=column)
        if min(table.shape) < 2:
            raise NotMeasurable(f"engine order {order} on casing {casing}: fewer than two E or two K")
        return table

    def run(self, case: CoatingCase, f_omega: float) -> pd.Series:
        """Return the row of one run from the table of divergence."""
        rows = of_case(self.divergence, case)
        rows = rows[np.abs(rows.f_omega - f_omega) < SAME_SPEED]
        if rows.empty:
            raise NotMeasurable(f"coating {case.name} has no run at f_omega = {f_omega:g}")
        return rows.iloc[0]


def read_rom_accuracy(path: str | Path) -> pd.DataFrame:
    """Read the table of the reduced model's accuracy; raises as `bladerub.io.tables.read`."""
    return tables.read(path, ["mode", "relative_error"])
