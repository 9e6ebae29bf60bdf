"""The study's peaks with finer bars under the same tip: how much the width of a bar decides.

A bar is an abradable element. With n times as many, the profile keeps its shape in metres and the coating
its stiffness per area; the time step stays. What remains is how the bars resolve the edge of the profile
(`bladerub.contact.tip.coverage`) and the wear under it.
"""

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.setup import fixed_steps
from bladerub.contact.spec import RunSpec
from bladerub.extras.verification.response import CASE_COLUMNS, Response, listed

REFINEMENTS = (1, 2, 4)
"""How many times finer the bars are; 1 are the study's."""

COLUMNS = [
    *(*CASE_COLUMNS, "order", "elements", "f_peak", "amplitude", "amplitude_change"),
    *("volume_change", "wear_difference", "status"),
]
"""Columns of ``finer_bars.csv``, described in ``io/columns.csv``."""


def with_finer_bars(blade: ReducedBlade, spec: RunSpec, times: int) -> RunSpec:
    """Return the run with bars `times` finer under the same tip, at the same time step."""
    spec = fixed_steps(blade, spec)
    return replace(
        spec,
        coating=replace(spec.coating, n_elements=spec.coating.n_elements * times),
        tip=replace(spec.tip, half_width=spec.tip.half_width * times),
        steps_per_element=math.ceil(spec.steps_per_element / times),
    )


def table(blade: ReducedBlade, config: Mapping[str, Any], peaks: pd.DataFrame) -> pd.DataFrame:
    """Find the peaks of the `CASES` in `peaks`, a table ``peaks.csv``, again with finer bars.

    A row for each peak and number of bars, with `COLUMNS`: the peak to which the response rises from the
    study's speed of the peak, and the wear at that speed.
    """
    rows: list[dict[str, Any]] = []
    for (case, peak), times in itertools.product(listed(peaks), REFINEMENTS):
        response = Response(blade, config, case, peak.order, partial(with_finer_bars, blade, times=times))
        start = float(peak.f_peak)
        speed = response.top(start)
        wear, amplitude = _wear(response.run(start), times), response.amplitude(speed)
        if times == 1:
            own_wear, own_amplitude = wear, amplitude
        rows.append(
            {name: getattr(case, name) for name in CASE_COLUMNS}
            | {
                "order": peak.order,
                "elements": config["contact"]["elements"] * times,
                "f_peak": speed,
                "amplitude": amplitude,
                "amplitude_change": amplitude / own_amplitude - 1,
                "volume_change": wear.sum() / own_wear.sum() - 1,
                "wear_difference": np.linalg.norm(wear - own_wear) / np.linalg.norm(own_wear),
                "status": response.run(start).status,
            }
        )
    return pd.DataFrame(rows, columns=COLUMNS)


def _wear(run: RunResult, times: int) -> np.ndarray:
    """Mean wear (8, N) under each of the study's bars, m."""
    return run.wear.reshape(len(run.wear), -1, times).mean(axis=2)
