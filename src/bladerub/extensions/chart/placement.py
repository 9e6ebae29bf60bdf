"""Where a cell is run next: bisection around the maxima of what the chart shows.

Every curve over speed is known at some speeds of the grid. Each of its local maxima that reaches a set share
of its greatest one has the intervals to both neighbours halved, until they are neighbours on the grid. A
lower local maximum may still hide a higher peak than its samples show, for the peaks are ragged. How often
that happens is measured on the study, which knows all speeds (`bladerub.extensions.chart.check`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np


def next_speeds(known: np.ndarray, curves: Sequence[np.ndarray], share: float) -> list[int]:
    """Return the speeds to run next, as ascending indices into the grid; none when all maxima are enclosed.

    Parameters
    ----------
    known : (n,) ndarray of bool
        Which speeds of the grid were run.
    curves : sequence of (n,) ndarray
        Quantities whose maxima are sought; NaN where not run, and where the maximum is not sought.
    share : float
        Local maxima below this share of the greatest are left as they are.
    """
    at = np.flatnonzero(known)
    wanted: set[int] = set()
    for curve in curves:
        values = np.nan_to_num(curve[at], nan=-np.inf)
        if not np.isfinite(values).any():
            continue
        left, right = np.append(-np.inf, values[:-1]), np.append(values[1:], -np.inf)
        high = (values >= left) & (values >= right) & (values >= share * values.max())
        ends = np.flatnonzero(high)
        for low, up in [*zip(ends - 1, ends, strict=True), *zip(ends, ends + 1, strict=True)]:
            if low >= 0 and up < at.size and at[up] - at[low] > 1:
                wanted.add(int(at[low] + at[up]) // 2)
    return sorted(wanted)
