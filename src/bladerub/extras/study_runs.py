"""The runs of a study one by one: all, and those that tables and claims rest on.

The latter are worth repetitions and a check of their error.
"""

from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from bladerub.settings.analysis import Peaks
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, between, coating_cases, keeps_history, speed_name, speeds
from bladerub.study.maps import CoatingMap, read_map
from bladerub.study.orders import peak_settings
from bladerub.study.paper import FIVE_LOBES, FOUR_LOBES, NEAR, TEN_LOBES, WORN
from bladerub.study.peaks import Response, peak
from bladerub.study.solver import row_of

LOBES = (*FIVE_LOBES, *((f_omega - NEAR, f_omega + NEAR) for f_omega in (TEN_LOBES, FOUR_LOBES)))
"""Speeds between which the claims on worn lobes look."""


class StudyRun(NamedTuple):
    """One point of the study's grid, a coating at a normalised speed; or a row of blades on it."""

    case: CoatingCase
    f_omega: float
    row: Any = None
    row_name: str = ""

    @property
    def name(self) -> str:
        """Path of the run's file below ``runs``, without its suffix: ``2nd_E2_K0.5_theta0/0.1900``."""
        return self.row_name or f"{self.case.name}/{speed_name(self.f_omega)}"


def study_runs(config: Config) -> list[StudyRun]:
    """List every run of the study."""
    row = row_of(config)
    return [StudyRun(case, f_omega, row) for case in coating_cases(config) for f_omega in speeds(config)]


def important_runs(config: Config, maps: Path) -> list[StudyRun]:
    """List the runs that tables and claims rest on, by the folder of maps; raises as `read_map`."""
    row = row_of(config)
    return [
        StudyRun(case, float(f_omega), row)
        for case in coating_cases(config)
        for f_omega in chosen(config, read_map(maps / f"{case.name}.h5"))
    ]


def chosen(config: Config, coating: CoatingMap) -> np.ndarray:
    """Choose such speeds (n,) of a coating, ascending, normalised: `judged`, and those of claims on lobes."""
    return np.union1d(judged(config, coating), coating.f_omega[on_lobes(coating.case, coating.f_omega)])


def judged(config: Config, coating: CoatingMap) -> np.ndarray:
    """Choose those of which divergence counts as well: peaks, their neighbours, and those with a history."""
    f_omega = coating.f_omega
    mask = with_history(config, coating.case, f_omega)
    settings = peak_settings(config, coating.case.casing)
    for order in settings.orders:
        index = nearest_speed(coating, order, settings)
        mask[max(index - 1, 0) : index + 2] = True
    return f_omega[mask]


def nearest_speed(coating: Response, order: float, settings: Peaks) -> int:
    """Return the place among the speeds of the peak or, where there is none, of where the order meets C1."""
    f_peak = peak(coating, order, settings).f_omega
    distance = order * coating.f_omega - coating.C1 if np.isnan(f_peak) else coating.f_omega - f_peak
    return int(np.argmin(np.abs(distance)))


def with_history(config: Config, case: CoatingCase, f_omega: np.ndarray) -> np.ndarray:
    """Which (n,) of the speeds `f_omega` have a history."""
    return np.array([keeps_history(config, case, float(f)) for f in f_omega])


def on_lobes(case: CoatingCase, f_omega: np.ndarray) -> np.ndarray:
    """Which (n,) of the speeds `f_omega` claims on worn lobes are about."""
    inside = np.array([between(f_omega, low, high) for low, high in LOBES])
    return inside.any(axis=0) & (case == WORN)
