"""The runs of one point of the chart: at which speeds, and what is kept of each.

1. The point is run at the coarse speeds, then around the maxima of `sought`: each Y_k within the windows of
   `bladerub.study.peaks`, and the greatest displacement over all speeds.
2. The intervals on both sides of each local maximum are halved until the neighbours on the grid are run.
   Local maxima below a set share of the greatest are left as they are. The peaks are ragged, so that a low
   local maximum may hide a higher peak; `bladerub.extras.chart.table.placement` measures how often it does.
3. Each run is the study's run of that coating and speed, and is measured as there.
4. Divergence is judged at the uniform speeds alone, as in `bladerub.study.growth`, with the longer run where
   the amplitude grows: the search must not weigh in the share of divergent speeds. The longer runs are made
   together after the search, which does not depend on them.
5. What an earlier search from other speeds found of the same runs is taken over: a whole chart after one
   within a budget computes the rest.
"""

from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from itertools import islice

import numpy as np

from bladerub.blade.model import ReducedBlade
from bladerub.contact.result import RunResult
from bladerub.contact.spec import RunSpec
from bladerub.contact.strips import element_area
from bladerub.extras.chart.point import MEASURES, ChartPoint, ChartSpeeds, chart_orders
from bladerub.settings.analysis import Analysis
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import confirmation_spec, judge, needs_confirmation
from bladerub.study.peaks import Response, amplitude_in_window
from bladerub.study.spectra import order_spectrum
from bladerub.study.wear import lobes

Search = Generator[list[RunSpec], list[RunResult], ChartPoint]
"""Yields runs, is sent their results, and returns the point in the end."""


def compute(
    searches: Mapping[CoatingCase, Search],
    solve: Callable[[Sequence[RunSpec]], Iterable[tuple[int, RunResult, float]]],
) -> Iterator[tuple[CoatingCase, ChartPoint]]:
    """Search together by `solve`, a `Solver.simulate_many` of one blade; yield each point when complete."""
    pending = {case: next(generator) for case, generator in searches.items()}
    while pending:
        solved = sorted(solve([spec for specs in pending.values() for spec in specs]))
        results, next_specs = (result for _, result, _ in solved), {}
        for case, specs in pending.items():
            try:
                next_specs[case] = searches[case].send(list(islice(results, len(specs))))
            except StopIteration as end:
                yield case, end.value
        pending = next_specs


def search(
    config: Config,
    case: CoatingCase,
    blade: ReducedBlade,
    speeds: ChartSpeeds,
    C1: np.ndarray,
    earlier: ChartPoint | None = None,
) -> Search:
    """Search for the maxima of a coating; `earlier` is a point of the same runs, at other of their speeds."""
    f_omega, orders = speeds.f_omega, chart_orders(config)
    amplitude = np.full((f_omega.size, len(orders)), np.nan)
    measures = {name: np.full(f_omega.size, np.nan) for name in MEASURES}
    point = ChartPoint(case, f_omega, C1, np.array(orders, float), amplitude, speeds.uniform, measures)
    analysis, share = config.analysis, config.chart.speeds.refine_above
    pending = np.flatnonzero(speeds.coarse).tolist()
    uniform: dict[int, tuple[RunSpec, np.ndarray, str]] = {}  # what tells whether runs diverge
    while pending:
        to_run = [index for index in pending if not _taken_over(point, earlier, index)]
        specs = [run_spec(config, case, f_omega[index]) for index in to_run]
        for index, spec, result in zip(to_run, specs, (yield specs), strict=True):
            amplitude[index] = _amplitudes(analysis, orders, spec, result)
            for name, value in _measured(analysis, blade, spec, result).items():
                measures[name][index] = value
            if speeds.uniform[index]:
                uniform[index] = spec, result.revolution_amplitude, result.status
        pending = next_speeds(point.known, sought(config, point, measures["peak"]).values(), share)
    settings = analysis.divergence
    growing = [index for index, (_, *end) in uniform.items() if needs_confirmation(*end, settings)]
    confirmations = yield [confirmation_spec(uniform[index][0], settings) for index in growing]
    longer = dict(zip(growing, (result.revolution_amplitude for result in confirmations), strict=True))
    for index, (_, *end) in uniform.items():
        measures["divergent"][index] = float(judge(*end, settings, longer.get(index)).divergent)
    return point


def _taken_over(point: ChartPoint, earlier: ChartPoint | None, index: int) -> bool:
    """Take into `point` what `earlier` knows of the run at one speed; return whether that is all."""
    needed = "divergent" if point.uniform[index] else "revolutions"
    if earlier is None or np.isnan(earlier.measures[needed][index]):
        return False
    point.spectrum_amplitude[index] = earlier.spectrum_amplitude[index]
    for name, values in earlier.measures.items():
        if name != "divergent" or point.uniform[index]:
            point.measures[name][index] = values[index]
    return True


def sought(config: Config, response: Response, peak: np.ndarray) -> dict[str, np.ndarray]:
    """Curves (n,) over speed whose maxima are sought, by column of the chart; NaN where not sought or run."""
    settings, orders = config.analysis.peaks, chart_orders(config)
    amplitudes = {f"Y{order}": amplitude_in_window(response, order, settings) for order in orders}
    return amplitudes | {"peak": peak}


def next_speeds(computed: np.ndarray, curves: Iterable[np.ndarray], share: float) -> list[int]:
    """Return the speeds to run next, as ascending indices into the grid; none once maxima are enclosed."""
    indices, midpoints = np.flatnonzero(computed), set()
    for curve in curves:
        values = np.nan_to_num(curve[indices], nan=-np.inf)
        if not np.isfinite(values).any():
            continue
        left, right = np.append(-np.inf, values[:-1]), np.append(values[1:], -np.inf)
        maxima = np.flatnonzero((values >= left) & (values >= right) & (values >= share * values.max()))
        for low, high in [*zip(maxima - 1, maxima, strict=True), *zip(maxima, maxima + 1, strict=True)]:
            if low >= 0 and high < indices.size and indices[high] - indices[low] > 1:
                midpoints.add(int(indices[low] + indices[high]) // 2)
    return sorted(midpoints)


def _amplitudes(analysis: Analysis, orders: Sequence[int], spec: RunSpec, result: RunResult) -> list[float]:
    """Largest amplitude on each of the engine orders, m."""
    reach = analysis.peaks.order_halfwidth + 1e-9
    order, amplitude = order_spectrum(
        result.radial_displacement, spec.revolutions, analysis.spectrum_revolutions, max(orders) + 1
    )
    return [float(amplitude[np.abs(order - engine_order) <= reach].max()) for engine_order in orders]


def _measured(analysis: Analysis, blade: ReducedBlade, spec: RunSpec, result: RunResult) -> dict[str, float]:
    return {
        "peak": float(np.nanmax(result.revolution_peak)),
        "worn_volume": float(result.wear.sum(axis=1) @ element_area(blade, spec)),
        "deepest_wear": float(result.wear.max()),
        "lobes": lobes(result.angle, result.wear, analysis.lobe_prominence),
        "unbounded": float(result.status == "unbounded"),
        "revolutions": result.n_steps * result.time_step * spec.f_omega * blade.f1_hz,
        **{f"energy_{name}": getattr(result.energy, name) for name in ("damping", "wear", "sliding")},
    }
