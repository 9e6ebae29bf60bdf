"""Which coating to choose: limits that a safe one keeps, and the coatings that no other is better than."""

from collections.abc import Mapping

import numpy as np
import pandas as pd

LIMITED = {
    "amplitude": "peak",
    "wear": "deepest_wear",
    "divergent_share": "divergent_share",
    "fatigue": "alternating",
}
"""Column of the chart that each of ``chart.limits`` is for; the last is of its stress."""


def broken_limits(chart: pd.DataFrame, limits: Mapping[str, float]) -> pd.DataFrame:
    """Return for each row of the chart which of the limits it breaks, a column of bool for each."""
    return pd.DataFrame({name: chart[LIMITED[name]] > limit for name, limit in limits.items()})


def pareto(chart: pd.DataFrame, limits: Mapping[str, float]) -> pd.DataFrame:
    """List the coatings to which no other of the same θ is better in both displacement and worn volume.

    Their rows of the chart, by ascending displacement, and ``safe``: whether all limits are kept.
    """
    judged = chart.assign(safe=~broken_limits(chart, limits).any(axis=1))
    fronts = []
    for _, rows in judged.groupby("theta"):
        ordered = rows.sort_values(["peak", "worn_volume"])
        best_before = np.minimum.accumulate(np.append(np.inf, ordered.worn_volume.to_numpy()[:-1]))
        fronts.append(ordered[ordered.worn_volume.to_numpy() < best_before])
    return pd.concat(fronts, ignore_index=True)
