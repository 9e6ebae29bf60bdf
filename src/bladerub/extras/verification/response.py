"""Response of a coating on one engine order, by runs made when they are asked for."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.spec import RunSpec
from bladerub.extras.verification.impact import Motion
from bladerub.settings.analysis import Analysis
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec, speeds
from bladerub.study.spectra import order_spectrum
from bladerub.study.variants import filled

CASES = [
    CoatingCase("2nd", *layer)
    for layer in [(0.11, 0.5, 0.0), (1.1, 0.5, 0.0), (2.0, 0.5, 0.0), (2.0, 0.5, 0.15), (20.0, 10.0, 0.0)]
]
"""Coatings of the paper whose peaks are compared: those of Figs. 8, 9, 15 and 16, and the stiffest."""

CASE_COLUMNS = ("casing", "E", "K", "theta")


def listed(peaks: pd.DataFrame) -> list[tuple[CoatingCase, Any]]:
    """List coating and row of the peaks of the `CASES` in a table ``peaks.csv``, or of all if it has none."""
    rows = filled(peaks[peaks.law == "theta"]).dropna(subset=["f_peak"]).itertuples()
    described = [(CoatingCase.described(row._asdict()), row) for row in rows]
    return [pair for pair in described if pair[0] in CASES] or described


def spectrum(run: RunResult | Motion, analysis: Analysis) -> tuple[np.ndarray, np.ndarray]:
    """Return engine orders and amplitudes (m) of a run, as the study has them."""
    n_revolutions = run.revolution_peak.size
    return order_spectrum(
        run.radial_displacement, n_revolutions, analysis.spectrum_revolutions, analysis.max_order
    )


def amplitude_on(order: float, run: RunResult | Motion, analysis: Analysis) -> float:
    """Return the amplitude of a run on an engine order, m, as in `bladerub.study.peaks`."""
    orders, amplitude = spectrum(run, analysis)
    window = np.abs(orders - order) <= analysis.peaks.order_halfwidth + 1e-9
    return float(amplitude[window].max())


@dataclass
class Response:
    """Response of `case` on an engine order; each run of the study is simulated after a `change`."""

    blade: ReducedBlade
    config: Config
    case: CoatingCase
    order: float
    change: Callable[[RunSpec], RunSpec]
    runs: dict[float, RunResult] = field(default_factory=dict)  # by speed

    def run(self, f_omega: float) -> RunResult:
        """Return the run at `f_omega`."""
        if f_omega not in self.runs:
            spec = self.change(run_spec(self.config, self.case, f_omega))
            self.runs[f_omega] = simulate(self.blade, spec)
        return self.runs[f_omega]

    def amplitude(self, f_omega: float) -> float:
        """Amplitude on the engine order, m."""
        return amplitude_on(self.order, self.run(f_omega), self.config.analysis)

    def top(self, f_omega: float) -> float:
        """Speed of the study at which the amplitude, rising from `f_omega` on, is greatest."""
        grid = speeds(self.config)
        index = int(np.argmin(np.abs(np.array(grid) - f_omega)))
        while True:
            neighbours = grid[max(index - 1, 0) : index + 2]
            best = grid.index(max(neighbours, key=self.amplitude))
            if best == index:
                return grid[index]
            index = best
