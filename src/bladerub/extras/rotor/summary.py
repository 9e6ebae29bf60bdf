"""Tables of rows: what each draw did, the distribution over those of a combination, patterns of the wear."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import binom

from bladerub.blade.model import ReducedBlade
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import element_angle
from bladerub.extras.rotor.plan import Combination, Patterns, Plan, described
from bladerub.extras.rows.spec import Row
from bladerub.extras.rows.study import OF_BLADES
from bladerub.settings.analysis import Analysis
from bladerub.settings.study import Config
from bladerub.study.grid import run_spec
from bladerub.study.growth import judge
from bladerub.study.manifest import read_manifest
from bladerub.study.store import read_run
from bladerub.study.wear import dominant_harmonic, lobes

WHAT = ["casing", "E", "K", "theta", "f_omega", "blades", "length_scatter", "frequency_scatter", "coupling"]
"""Columns that name a combination, as `bladerub.extras.rotor.plan.described` does."""

MEASURED = [
    "row_amplitude",
    "amplification",
    "longest_amplification",
    "longest_share",
    "largest_share",
    "wear_harmonic_share",
]
"""Columns of draws whose distribution is of interest."""

_STATISTICS = ("median", "low", "high", "p05", "p95")
COLUMNS = [
    *WHAT,
    "rows",
    "unbounded_rows",
    "divergent_rows",
    *(f"{name}_{statistic}" for name in MEASURED for statistic in _STATISTICS),
    "wear_harmonic",
    "wear_harmonic_rows",
    "lobes_lowest",
    "lobes_highest",
    "energy_residual",
]
"""Columns of the table of combinations."""


def draws(plan: Plan, folder: str | Path, analysis: Analysis) -> pd.DataFrame:
    """List every draw of `plan`, whose runs are in `folder`: a row each."""
    single, rows = {}, []  # amplitudes of single nominal blades, which are read first
    for combination in sorted(plan.draws, key=lambda combination: combination.blades):
        runs = Path(folder) / combination.name
        for draw, listed in enumerate(read_manifest(runs / "manifest.tsv")):
            of_draw = _measure(runs / listed.file, analysis)
            nominal = single.setdefault(combination.alone, of_draw["row_amplitude"])
            of_draw["amplification"] /= nominal
            of_draw["longest_amplification"] /= nominal
            rows.append(described(combination) | {"draw": draw} | of_draw)
    return pd.DataFrame(rows)


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
        "amplification": float(np.fmax.reduce(amplitude)),  # over 1 m here and in the next line
        "longest_amplification": float(some * amplitude[longest]),
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
    """Sum up the draws of each combination: medians, quantiles, and the 95 % interval of the median.

    The amplitude of a row that ended early is that of its last revolutions, as far as they were made.
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
        for name in MEASURED:
            values = _statistics(of_what[name].dropna().to_numpy())
            row |= dict(zip((f"{name}_{statistic}" for statistic in _STATISTICS), values, strict=True))
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


def patterns(config: Config, blade: ReducedBlade, plan: Plan) -> pd.DataFrame:
    """Follow the pattern that each row wears, whether it turns around the casing: a line an interval."""
    lines = []
    for combination, n_draws in plan.followed.items():
        spec = run_spec(config, combination.case, combination.f_omega)
        for draw in range(n_draws):
            what = described(combination) | {"draw": draw, "pattern_harmonic": plan.patterns.harmonic}
            row = plan.row(combination, draw)
            lines += [what | line for line in _of_row(blade, spec, row, plan.patterns)]
    return pd.DataFrame(lines)


def _of_row(blade: ReducedBlade, spec: RunSpec, row: Row, patterns: Patterns) -> list[dict[str, float]]:
    """Look at the wear every few revolutions, within the displacement limit; one NaN if never there."""
    from bladerub.extras.rows.row import simulate_row  # loads the compiler, which the tables do without

    ends, wear = [], [np.zeros(spec.coating.n_elements)]
    for last in range(patterns.interval, spec.revolutions + 1, patterns.interval):
        # a shorter run is the beginning of the longer one, bit by bit
        result = simulate_row(blade, replace(spec, revolutions=last), row)
        if result.unbounded:
            break
        ends.append(last)
        wear.append(result.wear.mean(axis=0))
    angle = element_angle(spec.coating.n_elements)
    coefficients = [component(angle, worn, patterns.harmonic) for worn in np.diff(wear, axis=0)]
    if not ends:
        ends, coefficients = [patterns.interval], [np.nan]
    lobe, depth = lobe_angle(np.array(coefficients), patterns.harmonic), np.abs(coefficients)
    drift = drift_rate(np.array(ends), lobe, depth)
    return [
        {"revolution": end, "pattern_angle": position, "pattern_depth": deep, "pattern_drift": drift}
        for end, position, deep in zip(ends, lobe, depth, strict=True)
    ]


def component(angle: np.ndarray, depth: np.ndarray, harmonic: int) -> complex:
    """Find c of ``depth = … + Re(c exp(i harmonic angle))``; `depth` (n,), m, at even angles (n,), rad."""
    return complex(2 * np.mean(depth * np.exp(-1j * harmonic * angle)))


def lobe_angle(coefficients: np.ndarray, harmonic: int) -> np.ndarray:
    """Find where a lobe of each `component` is, rad: the nearest of its lobes to where it was before."""
    return np.unwrap(-np.angle(coefficients)) / harmonic


def drift_rate(revolution: np.ndarray, angle: np.ndarray, depth: np.ndarray) -> float:
    """Find the rate at which lobes move, rad a revolution, positive with the rotation; NaN of fewer than 3.

    The least-squares slope of `angle` over `revolution`, weighted by what was worn off in each interval.
    """
    if revolution.size < 3 or not depth.any():
        return np.nan
    return float(np.polyfit(revolution, angle, 1, w=np.sqrt(depth))[0])


def drifts(followed: pd.DataFrame) -> pd.DataFrame:
    """Sum up `patterns`: median, 5 and 95 % quantile of the drift over the draws of each combination."""
    of_rows = followed.drop_duplicates([*WHAT, "draw"])
    drift = of_rows.groupby([*WHAT, "pattern_harmonic"], sort=False)["pattern_drift"]
    quantiles = {"median": 0.5, "p05": 0.05, "p95": 0.95}.items()
    summary = pd.DataFrame({f"pattern_drift_{name}": drift.quantile(level) for name, level in quantiles})
    summary["rows"], summary["followed_rows"] = drift.size(), drift.count()
    return summary.reset_index()
