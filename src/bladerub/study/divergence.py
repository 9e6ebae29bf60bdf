"""Divergence: the table of which runs' amplitudes keep growing, as `bladerub.study.growth` defines it."""

from collections.abc import Iterable, Mapping
from dataclasses import asdict
from pathlib import Path
from typing import Any

import pandas as pd

from bladerub.study.growth import judge
from bladerub.study.maps import CoatingMap, read_map

COLUMNS = [
    *("casing", "E", "K", "theta", "f_omega"),
    *("growth_per_revolution", "saturating", "divergent", "lobes"),
    *("growth_low", "growth_high", "revolutions", "status", "law"),
]
"""Columns of ``divergence.csv``: f_omega is normalised, growth relative (0.03 is 3 % a revolution).

``growth_*``, ``revolutions`` and ``status`` are of the run that the verdict rests on, the longer one if there
is one; ``lobes`` are of the study's own run.
"""


def table(config: Mapping[str, Any], map_paths: Iterable[str | Path]) -> pd.DataFrame:
    """Judge every run of the study: `of_maps` on the files of `bladerub.study.maps.build_map`."""
    return of_maps(config, map(read_map, map_paths))


def of_maps(config: Mapping[str, Any], maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Judge every run of the maps by ``analysis.divergence``: a row each, with `COLUMNS`."""
    settings = config["analysis"]["divergence"]
    rows = []
    for coating in maps:
        for f_omega, amplitude, longer, lobes, status in zip(
            coating.f_omega,
            coating.revolution_amplitude,
            coating.confirmation_amplitude,
            coating.lobes,
            coating.status,
            strict=True,
        ):
            verdict = judge(amplitude, status, settings, longer)
            rows.append(
                asdict(coating.case)
                | {
                    "f_omega": f_omega,
                    "growth_per_revolution": verdict.growth.per_revolution,
                    "growth_low": verdict.growth.low,
                    "growth_high": verdict.growth.high,
                    "saturating": verdict.saturating,
                    "divergent": verdict.divergent,
                    "lobes": lobes,
                    "revolutions": verdict.revolutions,
                    "status": verdict.status,
                }
            )
    return pd.DataFrame(rows, columns=COLUMNS)
