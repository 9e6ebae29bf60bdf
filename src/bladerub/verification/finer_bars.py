"""The study's peaks with finer bars under the same tip: how much the width of a bar decides.

A bar is an abradable element. With n times as many, the profile keeps its shape in metres and the coating
its stiffness per area; the time step stays. What remains is how the bars resolve the edge of the profile
(`bladerub.contact.tip.coverage`) and the wear under it.
"""

import itertools
import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.spec import RunSpec
from bladerub.study.grid import CoatingCase, run_spec, speeds
from bladerub.study.spectra import order_spectrum

CASES = [
    CoatingCase("2nd", *layer)
    for layer in [(0.11, 0.5, 0.0), (1.1, 0.5, 0.0), (2.0, 0.5, 0.0), (2.0, 0.5, 0.15), (20.0, 10.0, 0.0)]
]
"""Coatings whose peaks are compared: those of Figs. 8, 9, 15 and 16, and the stiffest."""

REFINEMENTS = (1, 2, 4)
"""How many times finer the bars are; 1 are the study's."""

COLUMNS = [
    *("casing", "E", "K", "theta", "order", "elements", "f_peak", "amplitude", "amplitude_change"),
    *("volume_change", "wear_difference", "status"),
]
"""Columns of ``finer_bars.csv``, described in ``io/columns.csv``."""


def with_finer_bars(spec: RunSpec, times: int) -> RunSpec:
    """Return the run with bars `times` finer under the same tip, at the same time step."""
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
    for (case, peak), times in itertools.product(_listed(peaks), REFINEMENTS):
        found = _Response(blade, config, case, peak.order, times)
        start = float(peak.f_peak)
        at = found.top(start)
        wear, amplitude = found.wear(start), found.amplitude(at)
        if times == 1:
            own_wear, own_amplitude = wear, amplitude
        rows.append(
            {name: getattr(case, name) for name in ("casing", "E", "K", "theta")}
            | {
                "order": peak.order,
                "elements": config["contact"]["elements"] * times,
                "f_peak": at,
                "amplitude": amplitude,
                "amplitude_change": amplitude / own_amplitude - 1,
                "volume_change": wear.sum() / own_wear.sum() - 1,
                "wear_difference": np.linalg.norm(wear - own_wear) / np.linalg.norm(own_wear),
                "status": found.runs[start].status,
            }
        )
    return pd.DataFrame(rows, columns=COLUMNS)


def _listed(peaks: pd.DataFrame) -> list[tuple[CoatingCase, Any]]:
    """List coating and row of the peaks of the `CASES`."""
    own = peaks[peaks.law == "theta"].itertuples()
    described = [(CoatingCase(row.casing, row.E, row.K, row.theta), row) for row in own]
    return [each for each in described if each[0] in CASES]


class _Response:
    """Response of one coating on one engine order, by runs made when they are asked for."""

    def __init__(
        self, blade: ReducedBlade, config: Mapping[str, Any], case: CoatingCase, order: float, times: int
    ):
        self.blade, self.config, self.case, self.order, self.times = blade, config, case, order, times
        self.runs: dict[float, RunResult] = {}

    def _run(self, f_omega: float) -> RunResult:
        if f_omega not in self.runs:
            spec = with_finer_bars(run_spec(self.config, self.case, f_omega), self.times)
            self.runs[f_omega] = simulate(self.blade, spec)
        return self.runs[f_omega]

    def amplitude(self, f_omega: float) -> float:
        """Amplitude on the engine order, m, as in `bladerub.study.peaks`."""
        run, analysis = self._run(f_omega), self.config["analysis"]
        order, amplitude = order_spectrum(
            run.radial_displacement,
            run.revolution_peak.size,
            analysis["spectrum_revolutions"],
            analysis["max_order"],
        )
        near = np.abs(order - self.order) <= analysis["peaks"]["order_halfwidth"] + 1e-9
        return float(amplitude[near].max())

    def top(self, f_omega: float) -> float:
        """Speed of the study at which the amplitude, rising from `f_omega` on, is greatest."""
        grid = speeds(self.config)
        at = int(np.argmin(np.abs(np.array(grid) - f_omega)))
        while True:
            near = grid[max(at - 1, 0) : at + 2]
            best = grid.index(max(near, key=self.amplitude))
            if best == at:
                return grid[at]
            at = best

    def wear(self, f_omega: float) -> np.ndarray:
        """Mean wear (8, N) under each of the study's bars, m."""
        wear = self._run(f_omega).wear
        return wear.reshape(len(wear), -1, self.times).mean(axis=2)
