"""Divergence: whether the amplitude of vibration keeps growing with time."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bladerub.study.maps import read_map

COLUMNS = [
    "casing",
    "E",
    "K",
    "theta",
    "f_omega",
    "growth_per_revolution",
    "divergent",
    "lobes",
    "status",
]
"""Columns of ``divergence.csv``; f_omega is normalised, growth_per_revolution relative (0.03 is 3 %)."""

AT_THE_END = 2
"""Last revolutions within which a growing amplitude has its maximum (one more than the last, for ripple)."""


def growth_per_revolution(revolution_peak: np.ndarray, revolutions: int) -> float:
    """Relative growth of the amplitude per revolution, by least squares on its logarithm.

    The amplitude is the largest absolute radial displacement of node 1 in each revolution. It includes the
    mean deflection under the rub, so a vibration about a deflected mean grows by more than this says.

    Parameters
    ----------
    revolution_peak : (n,) ndarray
        Amplitude in each revolution, m; NaN after an early end.
    revolutions : int
        The last ones, over which growth is fitted; of a run that ended early, the last before the end.

    Returns
    -------
    float
        Growth g such that the amplitude goes as ``(1 + g) ** revolution``; 0 for a blade that never moved,
        NaN when fewer than two revolutions can be fitted.
    """
    amplitude = revolution_peak[np.isfinite(revolution_peak)][-revolutions:]
    if amplitude.size and not amplitude.any():
        return 0.0
    number = np.flatnonzero(amplitude > 0)
    if number.size < 2:
        return float("nan")
    slope, _ = np.polyfit(number, np.log(amplitude[number]), 1)
    return float(np.expm1(slope))


def is_divergent(revolution_peak: np.ndarray, status: str, settings: Mapping[str, Any]) -> bool:
    """Tell whether a run diverges, in the paper's words: the amplitude continuously grows with time.

    It does where the blade left all bounds, or where the amplitude grows by more than
    ``settings["growth"]`` a revolution over the last ``settings["revolutions"]`` and is greatest at the
    end: a beat that has passed its maximum grows no more.

    Parameters
    ----------
    revolution_peak : (n,) ndarray
        Amplitude in each revolution, m.
    status : str
        Of the run.
    settings : mapping
        ``config["analysis"]["divergence"]``.
    """
    if status == "unbounded":
        return True
    grows = growth_per_revolution(revolution_peak, settings["revolutions"]) > settings["growth"]
    return bool(grows and np.argmax(revolution_peak) >= revolution_peak.size - AT_THE_END)


def table(config: Mapping[str, Any], map_paths: Iterable[str | Path]) -> pd.DataFrame:
    """Judge every run of the maps.

    Parameters
    ----------
    config : mapping
        ``analysis.divergence`` has the revolutions to fit over and the growth called divergent.
    map_paths : iterable of path-like
        Files of `bladerub.study.maps.build_map`.

    Returns
    -------
    DataFrame
        A row per run, with `COLUMNS`.
    """
    settings = config["analysis"]["divergence"]
    rows = []
    for coating in map(read_map, map_paths):
        case = coating.case
        for f_omega, peaks, count, status in zip(
            coating.f_omega, coating.revolution_peak, coating.lobes, coating.status, strict=True
        ):
            growth = growth_per_revolution(peaks, settings["revolutions"])
            divergent = is_divergent(peaks, status, settings)
            rows.append((case.casing, case.E, case.K, case.theta, f_omega, growth, divergent, count, status))
    return pd.DataFrame(rows, columns=COLUMNS)
