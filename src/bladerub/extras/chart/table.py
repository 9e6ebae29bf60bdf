"""Tables of the chart: its points, their stress, which coating to choose, and how well the search does."""

from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.model import ReducedBlade
from bladerub.extras.chart import point as files
from bladerub.extras.chart.plan import chart_speeds
from bladerub.extras.chart.point import ChartPoint, PointRow, chart_orders
from bladerub.extras.chart.search import next_speeds, sought
from bladerub.extras.chart.settings import Limits
from bladerub.io import tables
from bladerub.io.errors import DamagedFile
from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.manifest import listed_files
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import maximum, peak

COATING = ["casing", "E", "K", "theta"]
"""Columns that identify the coating of a row."""

STRESS = [*COATING, "alternating", "f_alternating"]
"""Columns of ``chart_stress.csv``."""

LIMITED = {
    "amplitude": "peak",
    "wear": "deepest_wear",
    "divergent_share": "divergent_share",
    "fatigue": "alternating",
}
"""Column of the chart that each of ``chart.limits`` is for; the last is of its stress."""

_CHOSEN = ["safe", "broken", "peak", "f_at_peak", "worn_volume", "deepest_wear", "divergent_share"]


def read_points(manifests: Iterable[str | Path]) -> Iterator[ChartPoint]:
    """Read the points that manifests of columns list; raises `OSError` if one is not as it is listed."""
    for path in manifests:
        for file in listed_files(path, PointRow):
            if file.is_damaged():
                raise DamagedFile(f"{file.path}: not the point of the chart that {path} lists")
            yield files.read(file.path)


def table(config: Config, points: Iterable[ChartPoint]) -> pd.DataFrame:
    """Sum up every point: Y_k and f_k, greatest measures, shares of the uniform speeds, number of runs."""
    rows, orders = [], chart_orders(config)
    for point in points:
        measures, row = point.measures, {name: getattr(point.case, name) for name in COATING}
        for order in orders:
            speed, amplitude, _ = peak(point, order, config.analysis.peaks)
            row |= {f"Y{order}": amplitude, f"f{order}": speed}
        highest = int(np.nanargmax(measures["peak"]))
        row |= {"peak": measures["peak"][highest], "f_at_peak": point.f_omega[highest]}
        row |= {name: np.nanmax(measures[name]) for name in ("worn_volume", "deepest_wear")}
        for name in ("divergent", "unbounded"):
            row[f"{name}_share"] = np.mean(measures[name][point.uniform])
        rows.append(row | {"runs": int(point.known.sum())})
    return pd.DataFrame(rows)


@threadpool_limits.wrap(limits=1, user_api="blas")  # the products are small
def stresses(mesh: str | Path, blade: ReducedBlade, config: Config, chart: pd.DataFrame) -> pd.DataFrame:
    """Find the largest alternating stress of each row of ``chart.csv``, to lay beside a fatigue limit.

    No run of the chart keeps its motion. Those with the greatest amplitude on each engine order and the
    greatest displacement are made again, a few of some fifty; the stress at another speed may be higher.
    """
    from bladerub.extras.stress.run import BladeStress  # the chart itself does without

    stress, rows = BladeStress(mesh, blade), []
    last = config.analysis.spectrum_revolutions
    speed_columns = ["f_at_peak", *(f"f{order}" for order in chart_orders(config))]
    for point in chart.to_dict("records"):
        coating, of_speed = [point[name] for name in COATING], {}
        for f_omega in sorted({point[name] for name in speed_columns if pd.notna(point[name])}):
            _, of_run = stress.of_run(run_spec(config, CoatingCase(*coating), f_omega), last)
            if of_run is not None:
                of_speed[f_omega] = of_run.last["alternating"]
        speed = max(of_speed, key=of_speed.get, default=None)
        rows.append((*coating, of_speed.get(speed), speed))
    return pd.DataFrame(rows, columns=STRESS)


def read_chart(chart: str | Path, stress: str | Path | None = None) -> pd.DataFrame:
    """Read ``chart.csv``, with the columns of ``chart_stress.csv`` where that is given."""
    rows = tables.read(chart)
    if stress is None:
        return rows
    return rows.merge(tables.read(stress, STRESS), on=COATING, how="left", validate="one_to_one")


def broken_limits(chart: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """Return which of the limits each row of the chart breaks; what is not known is not within its limit."""
    return pd.DataFrame(
        {name: ~(chart[LIMITED[name]] <= limit) for name, limit in limits if limit is not None}
    )


def pareto(chart: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """List the coatings to which no other of the same θ is better in both displacement and worn volume."""
    judged = chart.assign(safe=~broken_limits(chart, limits).any(axis=1))
    ordered = judged.sort_values(["theta", "peak", "worn_volume"], ignore_index=True)
    lowest = ordered.groupby("theta").worn_volume.cummin()
    lowest_before = lowest.groupby(ordered.theta).shift(fill_value=np.inf)
    return ordered[ordered.worn_volume < lowest_before].reset_index(drop=True)


def recommended(chart: pd.DataFrame, limits: Limits) -> pd.DataFrame:
    """Recommend for each θ the coating with the lowest displacement of those that break the fewest limits."""
    judged = chart.assign(broken=broken_limits(chart, limits).sum(axis=1))
    judged["safe"] = judged["broken"] == 0
    rows = []
    for _, coatings in judged.groupby("theta"):
        best = coatings.sort_values(["broken", "peak", "worn_volume"]).iloc[0]
        row, near = dict(best[[*COATING, *_CHOSEN]]), []
        for name, moduli in coatings[["E", "K"]].items():
            below, above = moduli[moduli < best[name]].max(), moduli[moduli > best[name]].min()
            row |= {f"{name}_below": below, f"{name}_above": above}
            near.append(moduli.isin([best[name], below, above]))
        around = coatings[near[0] & near[1]].drop(best.name)
        rows.append(
            row
            | {"neighbours": len(around), "safe_neighbours": int(around["safe"].sum())}
            | {"lowest_neighbour": around["peak"].min(), "highest_neighbour": around["peak"].max()}
            | {"safe_coatings": int(coatings["safe"].sum()), "coatings": len(coatings)}
        )
    return pd.DataFrame(rows)


def placement(config: Config, maps: Iterable[CoatingMap]) -> pd.DataFrame:
    """Compare what the search finds on coatings of the study with the greatest that is there, by quantity."""
    speeds, share, rows = chart_speeds(config), config.chart.speeds.refine_above, []
    for coating in maps:
        curves = sought(config, coating, np.nanmax(coating.revolution_peak, axis=1))
        computed = speeds.coarse.copy()
        while pending := next_speeds(computed, curves.values(), share):
            computed[pending] = True
        for quantity, curve in curves.items():
            highest, top = maximum(coating, np.where(computed, curve, np.nan)), maximum(coating, curve)
            if np.isnan(highest.amplitude):
                continue  # no run with a spectrum, so nothing to find
            rows.append(
                {name: getattr(coating.case, name) for name in COATING}
                | {"quantity": quantity, "found": highest.amplitude, "f_found": highest.f_omega}
                | {"greatest": top.amplitude, "f_greatest": top.f_omega}
                | {"missed": 1 - highest.amplitude / top.amplitude}
            )
    return pd.DataFrame(rows)


def placement_summary(compared: pd.DataFrame) -> pd.DataFrame:
    """Count, for each quantity, the coatings found exactly, to 1 % and to 5 %, and the worst miss."""
    counted = compared.groupby("quantity").missed.agg(
        coatings="size",
        exact=lambda misses: (misses == 0).sum(),
        within_1_percent=lambda misses: (misses <= 0.01).sum(),
        within_5_percent=lambda misses: (misses <= 0.05).sum(),
        worst_missed="max",
    )
    return counted.reset_index()


def agreement(chart: pd.DataFrame, compared: pd.DataFrame) -> pd.DataFrame:
    """Compare those points of the chart that are coatings of the study with what the search finds there."""
    quantities = [name for name in chart.columns if name in set(compared.quantity)]
    values = chart.melt(COATING, quantities, "quantity", "in_chart")
    both = compared.merge(values, on=[*COATING, "quantity"])
    return both.assign(disagreement=both.in_chart / both.found - 1)
