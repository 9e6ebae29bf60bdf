"""Divergence: the table of which runs' amplitudes keep growing, as `bladerub.study.growth` defines it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.study.growth import judge
from bladerub.study.maps import CoatingMap, read_map

COLUMNS = [
    "casing",
    "E",
    "K",
    "theta",
    "f_omega",
    "growth_per_revolution",
    "saturating",
    "divergent",
    "lobes",
    "growth_low",
    "growth_high",
    "revolutions",
    "status",
    "law",
]
"""Columns of ``divergence.csv``: f_omega is normalised, growth relative (0.03 is 3 % a revolution).

``growth_*``, ``revolutions`` and ``status`` are of the run that the verdict rests on, the longer one if there
is one; ``lobes`` are of the study's own run.
"""


def table(config: Mapping[str, Any], map_paths: Iterable[str | Path]) -> pd.DataFrame:
    """Judge every run of the study: `of_maps` on the files of `bladerub.study.maps.build_map`."""
    return of_maps(config, map(read_map, map_paths))


def of_maps(config: Mapping[str, Any], maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Judge every run of the maps.

    Parameters
    ----------
    config : mapping
        ``analysis.divergence`` has the thresholds.
    maps : iterable of CoatingMap
        The coatings.

    Returns
    -------
    DataFrame
        A row per run, with `COLUMNS`.
    """
    settings = config["analysis"]["divergence"]
    rows = []
    for coating in maps:
        case = coating.case
        for f_omega, amplitude, longer, lobes, status in zip(
            coating.f_omega,
            coating.revolution_amplitude,
            coating.confirmation_amplitude,
            coating.lobes,
            coating.status,
            strict=True,
        ):
            verdict = judge(amplitude, status, settings, longer)
            growth = verdict.growth
            rows.append(
                {
                    "casing": case.casing,
                    "E": case.E,
                    "K": case.K,
                    "theta": case.theta,
                    "f_omega": f_omega,
                    "growth_per_revolution": growth.per_revolution,
                    "saturating": verdict.saturating,
                    "divergent": verdict.divergent,
                    "lobes": lobes,
                    "growth_low": growth.low,
                    "growth_high": growth.high,
                    "revolutions": verdict.revolutions,
                    "status": verdict.status,
                    "law": case.law,
                }
            )
    return pd.DataFrame(rows, columns=COLUMNS)
