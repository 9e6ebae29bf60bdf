"""Tables of rows: what each draw did, and the distribution over the draws of a combination."""

from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import binom

from bladerub.extras.rotor.plan import Combination, Plan, described
from bladerub.extras.rows.study import OF_BLADES
from bladerub.settings.analysis import Analysis
from bladerub.study.growth import judge
from bladerub.study.manifest import read_manifest
from bladerub.study.store import read_run
from bladerub.study.wear import dominant_harmonic, lobes

WHAT = ["casing", "E", "K", "theta", "f_omega", "blades"]
WHAT += ["length_scatter", "frequency_scatter", "coupling"]
"""Columns that name a combination, as `bladerub.extras.rotor.plan.described` does."""

DRAWS = [*WHAT, "draw", "status", "n_unbounded", "row_amplitude", "amplification", "longest_amplification"]
DRAWS += ["longest_share", "largest_share", "max_wear", "wear_harmonic", "wear_harmonic_share", "lobes"]
DRAWS += ["divergent", "energy_residual"]
"""Columns of the table of draws."""

COLUMNS = [*WHAT, "rows", "unbounded_rows", "divergent_rows"]
_MEASURED = ("row_amplitude", "amplification", "longest_amplification", "longest_share", "largest_share")
_MEASURED += ("wear_harmonic_share",)
_STATISTICS = ("median", "low", "high", "p05", "p95")
COLUMNS += [f"{name}_{statistic}" for name in _MEASURED for statistic in _STATISTICS]
COLUMNS += ["wear_harmonic", "wear_harmonic_rows", "lobes_lowest", "lobes_highest", "energy_residual"]
"""Columns of the table of combinations."""


def draws(plan: Plan, folder: str | Path, analysis: Analysis) -> pd.DataFrame:
    """List every draw of `plan`, whose runs are in `folder`: a row each, with `DRAWS`.

    Lobes are counted and growth is judged by ``config.analysis``. Raises `OSError`, naming the file, if a
    run is missing or damaged.
    """
    single: dict[Combination, float] = {}  # amplitudes of single nominal blades, which are read first
    rows = []
    for combination in sorted(plan.draws, key=lambda combination: combination.blades):
        runs = Path(folder) / combination.name
        for draw, listed in enumerate(read_manifest(runs / "manifest.tsv")):
            of_draw = _measure(runs / listed.file, analysis)
            nominal = single.setdefault(combination.alone, of_draw["row_amplitude"])
            of_draw["amplification"] = of_draw["row_amplitude"] / nominal
            of_draw["longest_amplification"] = of_draw.pop("longest_amplitude") / nominal
            rows.append(described(combination) | {"draw": draw} | of_draw)
    return pd.DataFrame(rows)[DRAWS]


def _measure(path: Path, analysis: Analysis) -> dict[str, Any]:
    run = read_run(path, {"angle", "wear", "revolution_amplitude", *OF_BLADES})
    data, share = run.data, run.data["blade_worn_volume"]
    share = share / share.sum() if share.sum() else np.full(share.size, np.nan)
    length, amplitude = data["blade_length"], data["blade_amplitude"]
    longest = int(np.argmax(length))
    harmonic, harmonic_share = dominant_harmonic(data["wear"])
    grown = judge(data["revolution_amplitude"], run.attributes["status"], analysis.divergence)
    some = 1.0 if np.ptp(length) > 0 else np.nan  # blade is longer than others
    return {
        "status": run.attributes["status"],
        "n_unbounded": int(data["blade_unbounded"].sum()),
        "row_amplitude": float(np.fmax.reduce(amplitude)),
        "longest_amplitude": float(some * amplitude[longest]),
        "longest_share": float(some * share[longest]),
        "largest_share": float(share.max()),
        "max_wear": float(data["wear"].max()),
        "wear_harmonic": harmonic,
        "wear_harmonic_share": harmonic_share,
        "lobes": lobes(data["angle"], data["wear"], analysis.lobe_prominence),
        "divergent": bool(grown.divergent),
        "energy_residual": float(run.attributes["energy_residual"]),
    }


def combinations(table: pd.DataFrame) -> pd.DataFrame:
    """Sum up the `table` of `draws`: a row for each combination, with `COLUMNS`.

    Of each measure the median over the draws with its 95 % interval (``low``, ``high``), which holds whatever
    the distribution, and the 5 and 95 % quantiles. The amplitude of a row that ended early is that of its
    last revolutions, as far as they were made.
    """
    rows = []
    for what, of_what in table.groupby(WHAT, sort=False):
        counts = of_what["wear_harmonic"].value_counts()
        row: dict[str, Any] = {
            **dict(zip(WHAT, what, strict=True)),
            "rows": len(of_what),
            "unbounded_rows": int((of_what["status"] == "unbounded").sum()),
            "divergent_rows": int(of_what["divergent"].sum()),
            "lobes_lowest": int(of_what["lobes"].min()),
            "lobes_highest": int(of_what["lobes"].max()),
            "wear_harmonic": int(counts.index[0]),
            "wear_harmonic_rows": int(counts.iloc[0]),
            "energy_residual": float(of_what["energy_residual"].max()),
        }
        for name in _MEASURED:
            values = zip(_STATISTICS, _statistics(of_what[name].dropna().to_numpy()), strict=True)
            row |= {f"{name}_{statistic}": value for statistic, value in values}
        rows.append(row)
    return pd.DataFrame(rows, columns=COLUMNS)


def first_half(table: pd.DataFrame) -> pd.DataFrame:
    """Take the first half of the draws of each combination that has two or more, for `combinations`."""
    n = table.groupby(WHAT)["draw"].transform("size")
    return table[(n > 1) & (table["draw"] < n // 2)]


def _statistics(values: np.ndarray) -> tuple[float, ...]:
    """Give the median with its interval between order statistics (sign test), and quantiles; NaN if empty."""
    if not values.size:
        return (np.nan,) * len(_STATISTICS)
    ordered, n = np.sort(values), values.size
    first = int(binom.ppf(0.025, n, 0.5))
    low, high = (ordered[first - 1], ordered[n - first]) if first > 0 else (np.nan, np.nan)
    median, p05, p95 = np.quantile(ordered, (0.5, 0.05, 0.95))
    return median, low, high, p05, p95


def label(combination: Combination) -> str:
    """Name a combination in a figure, by what distinguishes rows on one coating at one speed."""
    coupled = f", disk {100 * combination.coupling:g} %" if combination.coupling else ""
    return (
        f"{combination.blades}: {1e6 * combination.length_scatter:g} µm, "
        f"{100 * combination.frequency_scatter:g} %{coupled}"
    )
