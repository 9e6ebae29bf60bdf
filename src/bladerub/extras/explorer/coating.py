"""One coating as the page holds it: pictures thinned and compressed, figures as they are.

What the numbers of a picture lose is below what it shows. Numbers that a reader may quote are not among them.
"""

import base64
import gzip
import json
import shlex
from typing import Any

import numpy as np
import pandas as pd

from bladerub.io.values import plain
from bladerub.plots.scales import ORDERS
from bladerub.study.grid import CoatingCase
from bladerub.study.manifest import ManifestRow
from bladerub.study.maps import CoatingMap
from bladerub.study.summary import displacement_peak, spectral_peak
from bladerub.study.variants import of_case

MOST_ANGLES = 500  # wear is averaged to at most so many arcs of the circumference
LAST_ORDER = ORDERS[-1] + 1  # up to which spectra are kept at least, the end of the axis of orders
AMPLITUDE_FLOOR = 1e-8  # smallest spectral amplitude that the page resolves, m; far below the colour scale
_SMALLEST = 1e-15  # amplitude of a blade at rest in the pictures of growth, m: a logarithmic axis has no zero
VERDICTS = ["growth_per_revolution", "growth_low", "growth_high", "saturating", "divergent", "revolutions"]
BANDS = [  # columns of ``run_bands.csv``: NaN for runs without an ensemble
    *("draws", "divergent_draws", "growth_rate_low", "growth_rate_high", "max_wear_low", "max_wear_high"),
    *("lobes_lowest", "lobes_highest"),
]
_ESCAPES = str.maketrans({"<": "\\u003c", ">": "\\u003e", "&": "\\u0026"})


def arcs(n_elements: int) -> np.ndarray:
    """First element of each arc of the circumference, and the end: (m + 1,) ndarray of int."""
    m = min(n_elements, MOST_ANGLES)
    return np.arange(m + 1) * n_elements // m


def kept_orders(f_omega: np.ndarray, order: np.ndarray, max_frequency: float) -> np.ndarray:
    """Count the entries of `order` (m,) kept at each `f_omega` (n,): to `max_frequency` and `LAST_ORDER`."""
    last = np.maximum(LAST_ORDER, max_frequency / f_omega) + order[1] - order[0]  # the bin around it is drawn
    return np.searchsorted(order, last, side="right")


def parts(
    coating: CoatingMap,
    divergence: pd.DataFrame,
    runs: list[ManifestRow],
    spectrum_revolutions: int,
    max_frequency: float,
) -> dict[str, str]:
    """Pack one coating, each part as `packed`.

    ``wear``: bytes, n speeds × m arcs, differences along the row of means in steps of 1/255 of its deepest.
    ``spectrum``: bytes, `logarithmic_steps` of the kept orders of each speed. ``growth``: the same in two
    bytes (little-endian), for each speed the revolutions of the study's run and of the longer run.
    ``figures``: JSON, `of_runs` and the scales, in mm.
    """
    bounds = arcs(coating.angle.size)
    wear = np.add.reduceat(coating.wear, bounds[:-1], axis=1, dtype=float) / np.diff(bounds)
    deepest = wear.max(axis=1)
    steps = np.rint(255 * (wear / np.where(deepest > 0, deepest, 1.0)[:, None])).astype(np.uint8)
    differences = np.diff(steps, axis=1, prepend=np.uint8(0))  # modulo 256: smooth rows compress better so
    counts = kept_orders(coating.f_omega, coating.spectrum_order, max_frequency)
    spectrum = np.concatenate([row[:n] for row, n in zip(coating.spectrum_amplitude, counts, strict=True)])
    spectrum_range = AMPLITUDE_FLOOR, log_range(spectrum, AMPLITUDE_FLOOR)[1]
    growth = np.hstack([coating.revolution_amplitude, coating.confirmation_amplitude])
    growth_range = log_range(growth, _SMALLEST)
    numbers = {
        "runs": of_runs(coating, divergence, runs, spectrum_revolutions),
        "deepest": mm(deepest),
        "spectrum_range": mm(spectrum_range),
        "growth_range": mm(growth_range),
        "revolutions": coating.revolution_amplitude.shape[1],
        "confirmation_revolutions": coating.confirmation_amplitude.shape[1],
    }
    return {
        "wear": packed(differences.tobytes()),
        "spectrum": packed(logarithmic_steps(spectrum, *spectrum_range, np.uint8).tobytes()),
        "growth": packed(logarithmic_steps(growth, *growth_range, np.uint16).astype("<u2").tobytes()),
        "figures": packed(json_text(numbers).encode()),
    }


def mm(metres: np.ndarray) -> np.ndarray:
    """Convert lengths; the page itself converts nothing."""
    return 1e3 * np.asarray(metres, dtype=float)


def of_runs(
    coating: CoatingMap, divergence: pd.DataFrame, runs: list[ManifestRow], spectrum_revolutions: int
) -> dict[str, list]:
    """Figures of every run of one coating, each a list over its speeds; lengths in mm.

    `VERDICTS`, `BANDS` (NaN without an ensemble) and ``verdict_status`` are of the run that the verdict rests
    on, all others of the run of the study: the peak of the last `spectrum_revolutions`, ``order`` and
    ``order_amplitude`` of the largest spectral amplitude, NaN without a spectrum. Raises `ValueError` if
    table, manifest and map are not of the same speeds.
    """
    verdicts = of_case(divergence, coating.case).sort_values("f_omega")
    sorted_runs = sorted(runs, key=lambda run: run.f_omega)
    listed = [run.f_omega for run in sorted_runs]
    for source, speeds in (("divergence.csv", verdicts["f_omega"]), ("manifest", listed)):
        if not np.array_equal(speeds, coating.f_omega):
            raise ValueError(f"{source}: not the speeds of the map of {coating.case.name}; make it again")
    peak = [displacement_peak(row, spectrum_revolutions) for row in coating.revolution_peak]
    bands = verdicts.reindex(columns=BANDS)
    bands[["max_wear_low", "max_wear_high"]] *= 1e3
    strongest = [spectral_peak(coating.spectrum_order, row) for row in coating.spectrum_amplitude]
    return {
        **verdicts[VERDICTS].to_dict("list"),
        **bands.to_dict("list"),
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
    coating = "--coating rigid" if case.is_rigid else f"--E {case.E:.12g} --K {case.K:.12g}"
    coating += f" --theta {case.theta:.12g}" if case.law == "theta" else f" --friction {case.friction:.12g}"
    overlays = f" --config {' '.join(map(shlex.quote, configs))}" if configs else ""
    options = "".join(f" --{key.replace('_', '-')} {value:.12g}" for key, value in case.own.items())
    return f"bladerub run{overlays} --casing {shlex.quote(case.casing)} {coating}{options}"


def logarithmic_steps(values: np.ndarray, low: float, high: float, dtype: type) -> np.ndarray:
    """Write `values` as whole numbers, 1 to the greatest in equal ratios from `low` to `high`, 0 for NaN."""
    top = np.iinfo(dtype).max
    share = np.log(np.clip(values, low, high) / low) / np.log(high / low)
    return np.where(np.isnan(values), 0, 1 + np.rint((top - 1) * np.nan_to_num(share))).astype(dtype)


def log_range(values: np.ndarray, floor: float) -> tuple[float, float]:
    """Find the ends of a logarithmic scale of `values` above `floor`, the upper at least twice the lower."""
    visible = values[values > floor]
    low = visible.min() if visible.size else floor
    return float(low), float(visible.max(initial=2 * low))


def packed(data: bytes) -> str:
    """Compress `data` (gzip) and write it as text (base64); equal data give equal text."""
    return base64.b64encode(gzip.compress(data, compresslevel=9, mtime=0)).decode("ascii")


def json_text(value: Any) -> str:
    """Write `value`, `plain`, as JSON that a script element can hold: nothing in it ends or begins one."""
    return json.dumps(plain(value), allow_nan=False, separators=(",", ":")).translate(_ESCAPES)
