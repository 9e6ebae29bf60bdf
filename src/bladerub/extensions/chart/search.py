"""The runs of one point of the chart: at which speeds, and what is kept of each.

1. The point is run at the coarse speeds, then around the maxima of `sought`: each Y_k within the windows of
   `bladerub.study.peaks`, and the greatest displacement over all speeds.
2. The intervals on both sides of each local maximum are halved until the neighbours on the grid are run.
   Local maxima below a set share of the greatest are left as they are. The peaks are ragged, so that a low
   local maximum may hide a higher peak; `bladerub.extensions.chart.check` measures how often it does.
3. Each run is the study's run of that coating and speed, and is measured as there.
4. Divergence is judged at the uniform speeds alone, as in `bladerub.study.growth`, with the longer run where
   the amplitude grows: the search must not weigh in the share of divergent speeds.
"""

from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.setup import element_area
from bladerub.contact.spec import RunSpec
from bladerub.extensions.chart.grid import ChartSpeeds, chart_orders
from bladerub.extensions.chart.point import MEASURES, ChartPoint
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import confirmation_spec, judge, needs_confirmation
from bladerub.study.peaks import Response, amplitude_in_window
from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import lobes


def compute(
    config: Mapping[str, Any], case: CoatingCase, blade: ReducedBlade, speeds: ChartSpeeds, C1: np.ndarray
) -> ChartPoint:
    """Run the coating `case` at the speeds that the search chooses; `C1` (n,) is normalised."""
    n, orders = speeds.f_omega.size, chart_orders(config)
    point = ChartPoint(
        case=case,
        f_omega=speeds.f_omega,
        C1=C1,
        spectrum_order=np.array(orders, dtype=float),
        spectrum_amplitude=np.full((n, len(orders)), np.nan),
        uniform=speeds.uniform,
        measures={name: np.full(n, np.nan) for name in MEASURES},
    )
    share, pending = config["chart"]["speeds"]["refine_above"], np.flatnonzero(speeds.coarse).tolist()
    while pending:
        for index in pending:
            _run(config, blade, point, index)
        pending = next_speeds(point.known, sought(config, point, point.measures["peak"]).values(), share)
    return point


def sought(config: Mapping[str, Any], response: Response, peak: np.ndarray) -> dict[str, np.ndarray]:
    """Curves (n,) over speed whose maxima are sought, by column of the chart; NaN where not sought or run.

    `peak` (n,) is the greatest displacement at each speed, m.
    """
    settings = config["analysis"]["peaks"]
    orders = chart_orders(config)
    amplitudes = {f"Y{order}": amplitude_in_window(response, order, settings) for order in orders}
    return amplitudes | {"peak": peak}


def next_speeds(known: np.ndarray, curves: Iterable[np.ndarray], share: float) -> list[int]:
    """Return the speeds to run next, as ascending indices into the grid; none once all maxima are enclosed.

    `known` (n,) are the speeds that were run, `curves` (n,) the quantities whose maxima are sought, NaN where
    not; local maxima below `share` of the greatest are left as they are.
    """
    at = np.flatnonzero(known)
    wanted: set[int] = set()
    for curve in curves:
        values = np.nan_to_num(curve[at], nan=-np.inf)
        if not np.isfinite(values).any():
            continue
        left, right = np.append(-np.inf, values[:-1]), np.append(values[1:], -np.inf)
        maxima = np.flatnonzero((values >= left) & (values >= right) & (values >= share * values.max()))
        for low, high in [*zip(maxima - 1, maxima, strict=True), *zip(maxima, maxima + 1, strict=True)]:
            if low >= 0 and high < at.size and at[high] - at[low] > 1:
                wanted.add(int(at[low] + at[high]) // 2)
    return sorted(wanted)


def _run(config: Mapping[str, Any], blade: ReducedBlade, point: ChartPoint, index: int) -> None:
    """Run `point` at one speed and put what is measured into it."""
    spec = run_spec(config, point.case, point.f_omega[index])
    result = simulate(blade, spec)
    point.spectrum_amplitude[index] = _amplitudes(config["analysis"], point.spectrum_order, spec, result)
    for name, value in _measured(config["analysis"], blade, spec, result).items():
        point.measures[name][index] = value
    if point.uniform[index]:
        point.measures["divergent"][index] = _diverges(config["analysis"], blade, spec, result)


def _amplitudes(
    analysis: Mapping[str, Any], orders: np.ndarray, spec: RunSpec, result: RunResult
) -> list[float]:
    """Largest amplitude on each of the engine orders, m."""
    halfwidth = analysis["peaks"]["order_halfwidth"]
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis["spectrum_revolutions"], orders.max() + 1
    )
    return [float(amplitude[np.abs(order - wanted) <= halfwidth + 1e-9].max()) for wanted in orders]


def _measured(
    analysis: Mapping[str, Any], blade: ReducedBlade, spec: RunSpec, result: RunResult
) -> dict[str, float]:
    return {
        "peak": float(np.nanmax(result.revolution_peak)),
        "worn_volume": float(result.wear.sum(axis=1) @ element_area(blade, spec)),
        "deepest_wear": float(result.wear.max()),
        "lobes": lobes(result.angle, result.wear, analysis["lobe_prominence"]),
        "unbounded": float(result.status == "unbounded"),
        "revolutions": result.n_steps * result.time_step * spec.f_omega * blade.f1_hz,
        **{f"energy_{name}": getattr(result.energy, name) for name in ("damping", "wear", "sliding")},
    }


def _diverges(analysis: Mapping[str, Any], blade: ReducedBlade, spec: RunSpec, result: RunResult) -> float:
    settings, longer = analysis["divergence"], None
    if needs_confirmation(result.revolution_amplitude, result.status, settings):
        longer = simulate(blade, confirmation_spec(spec, settings)).revolution_amplitude
    return float(judge(result.revolution_amplitude, result.status, settings, longer).divergent)
