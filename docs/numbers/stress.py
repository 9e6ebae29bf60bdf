"""Numbers of docs/how-to/stress.md."""

import pandas as pd

from docs.numbers import fixed, mm, percent, rows, table

_HEADINGS = ["stress, MPa", "lowest peak", "highest peak", "median on engine order 4", "on 6"]


def numbers(tables):
    """Return the text for each name on the page."""
    stress, cost = tables["stress"], tables["benchmark"]["cost_of_stress"]
    order4, order6 = rows(stress, order=4), rows(stress, order=6)
    slope4, slope6 = (peaks["last_alternating"] / peaks["amplitude"] / 1e9 for peaks in (order4, order6))
    heights = stress["last_von_mises_z"].round(4)
    stresses = [
        [kind, *_statistics(*(peaks[column] for peaks in (stress, order4, order6)))]
        for kind, column in (("von Mises", "last_von_mises"), ("alternating", "last_alternating"))
    ]
    return {
        "cost": percent(cost.max() - 1, 1),
        "peaks": fixed(len(stress)),
        "stresses": table(pd.DataFrame(stresses, columns=_HEADINGS)),
        "rotation_share": percent((stress["rotation_von_mises"] / stress["last_von_mises"]).median()),
        "stress_per_mm": f"{fixed(slope4.quantile(0.25))} to {fixed(slope4.quantile(0.75))}",
        "stress_per_mm_highest": fixed(slope6.max()),
        "at_one_height": fixed((heights == heights.mode()[0]).sum()),
        "height": mm(stress["last_von_mises_z"].mode()[0] - 0.4582, 0),
    }


def _statistics(every, order4, order6):
    return [fixed(value / 1e6) for value in (every.min(), every.max(), order4.median(), order6.median())]
