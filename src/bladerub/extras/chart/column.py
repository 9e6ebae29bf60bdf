"""The job of one column of the chart: every point that is missing or stale, and the rows of its manifest."""

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path

import numpy as np

from bladerub.blade.frequencies import reduced_frequencies
from bladerub.blade.model import ReducedBlade
from bladerub.contact.laws import law_digest
from bladerub.contact.sources import solver_digest
from bladerub.extras.chart import point as points
from bladerub.extras.chart.plan import chart_speeds
from bladerub.extras.chart.point import ChartSpeeds, PointRow, chart_orders
from bladerub.extras.chart.search import compute, search
from bladerub.io import lock
from bladerub.io.checksum import file_checksum
from bladerub.io.sources import digest_of
from bladerub.settings.study import Config
from bladerub.study.cache import Entry, digest
from bladerub.study.grid import CoatingCase, element_law, run_spec
from bladerub.study.solver import each_done, solver_of


def chart_digest() -> str:
    """Digest the source of what chooses the speeds of a point of the chart and what it keeps of each run."""
    measuring = (f"study/{name}.py" for name in ("spectra", "peaks", "growth", "wear"))
    return digest_of("blade/frequencies.py", *measuring, "extras/chart/point.py", "extras/chart/search.py")


def determinants(config: Config, case: CoatingCase, speeds: ChartSpeeds) -> str:
    """Digest all that determines the file of the point of a coating but the blade."""
    return digest(
        {
            "runs": run_determinants(config, case, speeds),
            "uniform": np.flatnonzero(speeds.uniform).tolist(),
            "coarse": np.flatnonzero(speeds.coarse).tolist(),
            "refine_above": config.chart.speeds.refine_above,
            "window": config.analysis.peaks.speed_window,
        }
    )


def run_determinants(config: Config, case: CoatingCase, speeds: ChartSpeeds) -> str:
    """Digest what determines its runs, whichever speeds the search chooses, and what is kept of them."""
    analysis = config.analysis
    return digest(
        solver_of(config).determinants()
        | law_digest(element_law(config))
        | {
            "spec": asdict(run_spec(config, case, f_omega=0.0)),
            "f_omega": speeds.f_omega.tolist(),
            "orders": chart_orders(config),
            "order_halfwidth": analysis.peaks.order_halfwidth,
            "spectrum_revolutions": float(analysis.spectrum_revolutions),
            "lobe_prominence": analysis.lobe_prominence,
            "divergence": {name: float(value) for name, value in analysis.divergence.plain().items()},
            "solver": solver_digest(),
            "chart": chart_digest(),
        }
    )


def plan_column(config: Config, cases: Sequence[CoatingCase]) -> dict[CoatingCase, str]:
    """Plan the points of a column: the `determinants` of each."""
    speeds = chart_speeds(config)
    return {case: determinants(config, case, speeds) for case in cases}


def compute_missing(
    config: Config,
    plan: Mapping[CoatingCase, str],
    blade: ReducedBlade,
    folder: str | Path,
    blade_digest: str,
    report: Callable[[str], None],
    threads: int = 1,
) -> list[PointRow]:
    """Compute those points of a column whose file is missing or stale, as `bladerub.study.job` does runs.

    `threads` points are computed at once, or all together by a solver that does so. Returns the manifest.
    """
    folder, speeds, first = Path(folder), chart_speeds(config), next(iter(plan))
    solver = solver_of(config)
    solve = partial(solver.simulate_many, blade, threads=threads if solver.wants_many else 1, report=report)
    column_lock = folder / f".{first.casing}_E{first.E:g}_theta{first.theta:g}.lock"
    entries, runs_keys, searches = {}, {}, {}
    for case, planned in plan.items():
        key = digest([planned, blade_digest])
        entries[case] = Entry(folder / f"{case.name}.h5", key, points.MEASURES.keys(), points.KEY)
        runs_keys[case] = digest([run_determinants(config, case, speeds), blade_digest])

    def compute_alone(case: CoatingCase) -> tuple[points.ChartPoint, float]:
        start = time.monotonic()
        ((_, point),) = compute({case: searches[case]}, solve)
        return point, start

    with lock.held(column_lock, lambda: report("another job is at work on this column: waiting for its end")):
        missing = [case for case, entry in entries.items() if not entry.fetch()]
        if missing:
            C1 = np.array([reduced_frequencies(blade, f, n_modes=1)[0] for f in speeds.f_omega]) / blade.f1_hz
        for case in missing:
            of_runs = replace(entries[case], key=runs_keys[case], attribute=points.RUNS_KEY)
            earlier = points.read(of_runs.path) if of_runs.fetch() else None
            searches[case] = search(config, case, blade, speeds, C1, earlier)
        results = each_done(compute_alone, searches, threads)
        if solver.wants_many:
            start = time.monotonic()
            results = ((case, (point, start)) for case, point in compute(searches, solve))
        for number, (case, (point, start)) in enumerate(results, 1):
            entries[case].make_room()
            points.write(entries[case].path, point, entries[case].key, runs_keys[case], config)
            runs = f"{point.known.sum()} runs in {time.monotonic() - start:.1f} s"
            report(f"[{number}/{len(missing)}] {case.name}: {runs}")
        return [
            PointRow(entry.path.name, entry.key, entry.path.stat().st_size, file_checksum(entry.path))
            for entry in entries.values()
        ]
