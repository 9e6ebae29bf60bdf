"""The numbers that the page shows as text, from the tables and maps of the study: lengths in mm."""

import shlex

import numpy as np
import pandas as pd

from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import ManifestRow
from bladerub.study.maps import CoatingMap
from bladerub.study.summary import displacement_peak, spectral_peak
from bladerub.study.variants import of_case

VERDICTS = ["growth_per_revolution", "growth_low", "growth_high", "saturating", "divergent", "revolutions"]
"""Columns of ``divergence.csv`` that the page shows, with the status of the run they rest on."""

BANDS = [
    *("draws", "divergent_draws", "growth_rate_low", "growth_rate_high", "max_wear_low", "max_wear_high"),
    *("lobes_lowest", "lobes_highest"),
]
"""Columns of ``run_bands.csv``: NaN for runs without an ensemble."""


def mm(metres: np.ndarray) -> np.ndarray:
    """Convert lengths; the page itself converts nothing."""
    return 1e3 * np.asarray(metres, dtype=float)


def of_runs(
    coating: CoatingMap, divergence: pd.DataFrame, runs: list[ManifestRow], spectrum_revolutions: int
) -> dict[str, list]:
    """Figures of every run of one coating, each a list over its speeds, from its map, table and manifest.

    `VERDICTS`, `BANDS` (NaN without an ensemble) and ``verdict_status`` are of the run that the verdict rests
    on, all others of the run of the study: lengths in mm, the peak of the last `spectrum_revolutions`,
    ``order`` and ``order_amplitude`` of the largest spectral amplitude, NaN without a spectrum. Raises
    `ValueError` if table, manifest and map are not of the same speeds.
    """
    verdicts = of_case(divergence, coating.case).sort_values("f_omega")
    sorted_runs = sorted(runs, key=lambda run: run.f_omega)
    for source, speeds in (
        ("divergence.csv", verdicts["f_omega"].to_numpy()),
        ("manifest", np.array([run.f_omega for run in sorted_runs])),
    ):
        if not np.array_equal(speeds, coating.f_omega):
            raise ValueError(f"{source}: not the speeds of the map of {coating.case.name}; make it again")
    peak = [displacement_peak(row, spectrum_revolutions) for row in coating.revolution_peak]
    bands = verdicts.reindex(columns=BANDS)
    bands[["max_wear_low", "max_wear_high"]] *= 1e3
    strongest = [spectral_peak(coating.spectrum_order, row) for row in coating.spectrum_amplitude]
    return {
        **{name: verdicts[name].tolist() for name in VERDICTS},
        **{name: bands[name].tolist() for name in BANDS},
        "verdict_status": verdicts["status"].tolist(),
        "status": coating.status.tolist(),
        "run_key": [run.run_key for run in sorted_runs],
        "lobes": coating.lobes.tolist(),
        "max_wear": mm(coating.max_wear).tolist(),
        "peak": mm(peak).tolist(),
        "order": [order for order, _ in strongest],
        "order_amplitude": mm([amplitude for _, amplitude in strongest]).tolist(),
    }


def command(case: CoatingCase, configs: list[str]) -> str:
    """Write the command that repeats a run of `case`, up to ``--f`` and the speed, which the page adds.

    `configs` are the files that were laid over config/config.yaml.
    """
    if case.is_rigid:
        coating = f"--coating rigid --friction {case.friction:.12g}"
    else:
        angle = f"--theta {case.theta:.12g}" if case.law == "theta" else f"--friction {case.friction:.12g}"
        coating = f"--E {case.E:.12g} --K {case.K:.12g} {angle}"
    overlays = f" --config {' '.join(map(shlex.quote, configs))}" if configs else ""
    options = "".join(f" --{key.replace('_', '-')} {value:.12g}" for key, value in case.own.items())
    return f"bladerub run{overlays} --casing {shlex.quote(case.casing)} {coating}{options}"
