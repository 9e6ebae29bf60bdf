"""Whether the pattern of the wear turns around the casing as it deepens."""

from dataclasses import replace

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import element_angle
from bladerub.extras.rotor.plan import Plan, described
from bladerub.extras.rotor.settings import Patterns
from bladerub.extras.rotor.summary import WHAT
from bladerub.extras.rows.row import simulate_row
from bladerub.extras.rows.spec import Row
from bladerub.settings.study import Config
from bladerub.study.grid import run_spec


def table(config: Config, blade: ReducedBlade, plan: Plan) -> pd.DataFrame:
    """Follow the worn pattern of each row among the patterns of `plan`: a line an interval.

    `config` is the study. Raises `ValueError` as `bladerub.extras.rows.row.simulate_row`.
    """
    lines = []
    for combination, draws in plan.followed.items():
        spec = run_spec(config, combination.case, combination.f_omega)
        for draw in range(draws):
            what = described(combination) | {"draw": draw, "pattern_harmonic": plan.patterns.harmonic}
            row = plan.row(combination, draw)
            lines += [what | line for line in _of_row(blade, spec, row, plan.patterns)]
    return pd.DataFrame(lines)


def _of_row(blade: ReducedBlade, spec: RunSpec, row: Row, patterns: Patterns) -> list[dict[str, float]]:
    """Look at the wear every few revolutions, as far as the row is within the displacement limit.

    NaN for the first look if it is not there.
    """
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
    """Find the rate at which lobes move, rad a revolution, positive with the rotation.

    The least-squares slope of `angle` over `revolution`, weighted by what was worn off in each interval; NaN
    with fewer than three intervals.
    """
    if revolution.size < 3 or not depth.any():
        return np.nan
    return float(np.polyfit(revolution, angle, 1, w=np.sqrt(depth))[0])


def drifts(followed: pd.DataFrame) -> pd.DataFrame:
    """Sum up the `table`: median, 5 and 95 % quantile of the drift over the draws of each combination.

    NaN where all rows of a combination left the displacement limit early.
    """
    of_rows = followed.drop_duplicates([*WHAT, "draw"])
    drift = of_rows.groupby([*WHAT, "pattern_harmonic"], sort=False)["pattern_drift"]
    quantiles = {"median": 0.5, "p05": 0.05, "p95": 0.95}
    summary = pd.DataFrame(
        {f"pattern_drift_{name}": drift.quantile(level) for name, level in quantiles.items()}
    )
    summary["rows"], summary["followed_rows"] = drift.size(), drift.count()
    return summary.reset_index()
