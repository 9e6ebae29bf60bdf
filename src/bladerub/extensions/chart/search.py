"""The runs of one cell of the chart: which ones, and what is taken of each.

1. The cell is run at the coarse speeds, then where `bladerub.extensions.chart.placement` says: around the
   maxima of Y4 and Y6 within the windows of `bladerub.study.peaks`, and of the displacement over all speeds.
2. Each run is the study's run of that coating and speed, and is measured as there.
3. Whether it diverges is judged at the uniform speeds alone, as in `bladerub.study.growth`, with the longer
   run where it grows: the share over them does not know where the search has looked closer.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import bar_area, simulate
from bladerub.contact.spec import RunResult, RunSpec
from bladerub.extensions.chart.cell import MEASURES, Cell
from bladerub.extensions.chart.grid import ORDERS, ChartSpeeds
from bladerub.extensions.chart.placement import next_speeds
from bladerub.study.confirmation import confirmation_spec
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import judge, needs_confirmation
from bladerub.study.peaks import amplitude_in_window
from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import lobes


def compute(
    config: Mapping[str, Any], case: CoatingCase, blade: ReducedBlade, speeds: ChartSpeeds, C1: np.ndarray
) -> Cell:
    """Run one coating where the search wants it, and judge it at the uniform speeds.

    Parameters
    ----------
    config : mapping
        The study.
    case : CoatingCase
        The coating.
    blade : ReducedBlade
        The blade.
    speeds : ChartSpeeds
        From `bladerub.extensions.chart.grid.chart_speeds`.
    C1 : (n,) ndarray
        Its first eigenfrequency at each speed, normalised.
    """
    cell = empty(case, speeds, C1)
    fill(cell, config, speeds, lambda index: _run(config, blade, cell, index))
    return cell


def empty(case: CoatingCase, speeds: ChartSpeeds, C1: np.ndarray) -> Cell:
    """Make a cell of which no speed was run yet."""
    n = speeds.f_omega.size
    return Cell(
        case=case,
        f_omega=speeds.f_omega,
        C1=C1,
        spectrum_order=np.array(ORDERS, dtype=float),
        spectrum_amplitude=np.full((n, len(ORDERS)), np.nan),
        uniform=speeds.uniform,
        measures={name: np.full(n, np.nan) for name in MEASURES},
    )


def fill(cell: Cell, config: Mapping[str, Any], speeds: ChartSpeeds, run: Callable[[int], None]) -> None:
    """Let `run` put into `cell` one speed after the other, until the search wants no more."""
    pending = np.flatnonzero(speeds.coarse).tolist()
    while pending:
        for index in pending:
            run(index)
        pending = next_speeds(
            cell.known, list(sought(cell, config).values()), config["chart"]["speeds"]["refine_above"]
        )


def sought(cell: Cell, config: Mapping[str, Any]) -> dict[str, np.ndarray]:
    """Curves (n,) over speed whose maxima the cell is after, by the column; NaN where they are not sought."""
    settings = config["analysis"]["peaks"]
    on_orders = {f"Y{order}": amplitude_in_window(cell, order, settings) for order in ORDERS}
    return on_orders | {"peak": cell.measures["peak"]}


def _run(config: Mapping[str, Any], blade: ReducedBlade, cell: Cell, index: int) -> None:
    spec = run_spec(config, cell.case, cell.f_omega[index])
    result = simulate(blade, spec)
    cell.spectrum_amplitude[index] = _amplitudes(config, spec, result)
    for name, value in _measured(config, blade, spec, result).items():
        cell.measures[name][index] = value
    if cell.uniform[index]:
        cell.measures["divergent"][index] = _diverges(config, blade, spec, result)


def _amplitudes(config: Mapping[str, Any], spec: RunSpec, result: RunResult) -> list[float]:
    """Largest amplitude on each of `ORDERS`, m."""
    analysis = config["analysis"]
    halfwidth = analysis["peaks"]["order_halfwidth"]
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis["spectrum_revolutions"], max(ORDERS) + 1
    )
    return [float(amplitude[np.abs(order - wanted) <= halfwidth + 1e-9].max()) for wanted in ORDERS]


def _measured(
    config: Mapping[str, Any], blade: ReducedBlade, spec: RunSpec, result: RunResult
) -> dict[str, float]:
    made = result.n_steps * result.time_step * spec.f_omega * blade.f1_hz
    return {
        "peak": float(np.nanmax(result.revolution_peak)),
        "worn_volume": float(result.wear.sum(axis=1) @ bar_area(blade, spec)),
        "deepest_wear": float(result.wear.max()),
        "lobes": lobes(result.angle, result.wear, config["analysis"]["lobe_prominence"]),
        "unbounded": float(result.status == "unbounded"),
        "revolutions": made,
        **{f"energy_{name}": getattr(result.energy, name) for name in ("damping", "wear", "sliding")},
    }


def _diverges(config: Mapping[str, Any], blade: ReducedBlade, spec: RunSpec, result: RunResult) -> float:
    settings, longer = config["analysis"]["divergence"], None
    if needs_confirmation(result.revolution_amplitude, result.status, settings):
        longer = simulate(blade, confirmation_spec(spec, settings)).revolution_amplitude
    return float(judge(result.revolution_amplitude, result.status, settings, longer).divergent)
