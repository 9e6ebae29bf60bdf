"""Which coating to choose: limits of a safe one, which to recommend, and those that no other betters."""

import numpy as np
import pandas as pd

from bladerub.extras.chart.settings import Limits
from bladerub.extras.chart.table import COATING

LIMITED = {
    "amplitude": "peak",
    "wear": "deepest_wear",
    "divergent_share": "divergent_share",
    "fatigue": "alternating",
}
"""Column of the chart that each of ``chart.limits`` is for; the last is of its stress."""

_OF_CHART = [
    *COATING,
    *("safe", "broken", "peak", "f_at_peak", "worn_volume", "deepest_wear", "divergent_share"),
]


def broken_limits(chart: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """Return for each row of the chart which of the limits it breaks, a column of bool for each.

    What is not known, such as the stress of runs that complete no revolution, is not within its limit.
    """
    return pd.DataFrame(
        {name: ~(chart[LIMITED[name]] <= limit) for name, limit in limits if limit is not None}
    )


def pareto(chart: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """List the coatings to which no other of the same θ is better in both displacement and worn volume.

    Their rows of the chart, by ascending displacement, and ``safe``: whether all limits are kept.
    """
    judged = chart.assign(safe=~broken_limits(chart, limits).any(axis=1))
    ordered = judged.sort_values(["theta", "peak", "worn_volume"], ignore_index=True)
    lowest = ordered.groupby("theta").worn_volume.cummin()
    lowest_before = lowest.groupby(ordered.theta).shift(fill_value=np.inf)
    return ordered[ordered.worn_volume < lowest_before].reset_index(drop=True)


def recommended(chart: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """Recommend for each θ the coating with the lowest displacement of those that break the fewest limits.

    How sure that is shows in its neighbours on the chart, eight or fewer (studies/chart/README.md).
    """
    judged = chart.assign(broken=broken_limits(chart, limits).sum(axis=1))
    judged["safe"] = judged["broken"] == 0
    rows = []
    for _, coatings in judged.groupby("theta"):
        best = coatings.sort_values(["broken", "peak", "worn_volume"]).iloc[0]
        ends = {
            name: {"below": moduli[moduli < best[name]].max(), "above": moduli[moduli > best[name]].min()}
            for name, moduli in coatings[["E", "K"]].items()
        }
        near = [coatings[name].isin([best[name], *ends[name].values()]) for name in ends]
        around = coatings[near[0] & near[1]].drop(best.name)
        rows.append(
            {
                **best[_OF_CHART],
                **{f"{name}_{side}": value for name in ends for side, value in ends[name].items()},
                "neighbours": len(around),
                "safe_neighbours": int(around["safe"].sum()),
                "lowest_neighbour": around["peak"].min(),
                "highest_neighbour": around["peak"].max(),
                "safe_coatings": int(coatings["safe"].sum()),
                "coatings": len(coatings),
            }
        )
    return pd.DataFrame(rows)
