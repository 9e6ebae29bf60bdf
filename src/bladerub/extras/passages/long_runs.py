"""Runs of hundreds of revolutions: what becomes of the runs that still grow, and of the peaks."""

import itertools
import time
from collections.abc import Callable, Iterable
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Annotated

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import simulate
from bladerub.contact.setup import compile_kernel
from bladerub.extras.study_runs import nearest_speed
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.settings.study import Config
from bladerub.study.divergence import verdicts
from bladerub.study.grid import CoatingCase, element_law, run_spec
from bladerub.study.growth import Verdict, growth, judge
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import peak_settings
from bladerub.study.variants import with_variant

COLUMNS = [
    *("casing", "E", "K", "theta", "f_omega", "why", "revolutions", "verdict", "growth_per_revolution"),
    *("late_amplitude", "max_wear", "status", "ms_per_revolution", "law"),
]
"""Columns of ``long_runs.csv``."""

DIED_OUT = 0.01
"""Share of the greatest amplitude below which a vibration has died out."""


_HALF_RANGE = "half the range of the radial displacement of node 1 in each revolution"
_RUNS, _REVOLUTIONS = ("run",), ("run", "revolution_number")


@dataclass(frozen=True)
class LongRuns:
    """The n long runs of one coating, of r revolutions; NaN after an unbounded end."""

    case: CoatingCase
    f_omega: Annotated[np.ndarray, _RUNS, "1", "rotational frequency, normalised"]
    why: Annotated[np.ndarray, _RUNS, "1", "why it was made"]  # ``grows``, or the peak, such as ``f4``
    revolution_number: Annotated[np.ndarray, _REVOLUTIONS[1:], "1", "revolution, counted from 1"]
    revolution_amplitude: Annotated[np.ndarray, _REVOLUTIONS, "m", _HALF_RANGE]
    max_wear: Annotated[np.ndarray, _RUNS, "m", "greatest worn depth"]
    status: Annotated[np.ndarray, _RUNS, "1", "completed or unbounded"]
    seconds: Annotated[np.ndarray, _REVOLUTIONS, "s", "wall time until the end of each revolution"]


DATASETS = {field.name: field.type.__metadata__ for field in fields(LongRuns) if field.name != "case"}
"""Dimensions, unit and meaning of each dataset."""


def chosen(config: Config, coating: CoatingMap) -> dict[float, str]:
    """Choose the runs that are made for longer: peaks, and completed ones that grow; the reasons by speed."""
    peaks = peak_settings(config, coating.case.casing)
    reasons = {
        float(coating.f_omega[nearest_speed(coating, order, peaks)]): f"f{order:g}" for order in peaks.orders
    }
    for f_omega, verdict in zip(coating.f_omega, verdicts(config, coating), strict=True):
        if verdict.divergent and verdict.status == "completed":
            reasons.setdefault(float(f_omega), "grows")
    return dict(sorted(reasons.items()))


def make(
    config: Config, coating: CoatingMap, blade: ReducedBlade, path: str | Path, report: Callable[[str], None]
) -> None:
    """Compute the long runs of a coating, of ``long_runs.revolutions``, and write them to the file `path`."""
    # or the time of the first run would include the loading of the machine code
    compile_kernel(bool(config.contact.tip_turns), blade.n_interface, element_law(config))
    case, revolutions = coating.case, config.long_runs.revolutions
    reasons = chosen(config, coating)
    results, ends, seconds = [], [0.0], np.full((len(reasons), revolutions), np.nan)
    for elapsed, (f_omega, why) in zip(seconds, reasons.items(), strict=True):
        spec = replace(run_spec(config, case, f_omega), revolutions=revolutions)
        ends[:] = [time.perf_counter()]
        results.append(simulate(blade, spec, lambda _: ends.append(time.perf_counter())))
        elapsed[: len(ends) - 1] = np.subtract(ends[1:], ends[0])
        report(f"{f_omega:.4f} ({why}): {results[-1].message}")
    amplitude = np.stack([result.revolution_amplitude for result in results])
    max_wear, status = zip(*((result.wear.max(), result.status) for result in results), strict=True)
    speeds, why = list(reasons), list(reasons.values())
    long = LongRuns(case, speeds, why, np.arange(1, revolutions + 1), amplitude, max_wear, status, seconds)
    variables = {
        name: Variable(dims, getattr(long, name), *about) for name, (dims, *about) in DATASETS.items()
    }
    hdf5.write(path, variables, asdict(case), provenance(config.plain()))


def read(path: str | Path) -> LongRuns:
    """Read what `make` has written; raises `OSError`, naming the file, if it is missing or damaged."""
    data, about = hdf5.read(path)
    try:
        return LongRuns(CoatingCase.described(about), **{name: data[name] for name in DATASETS})
    except KeyError as error:
        raise DamagedFile(f"{path}: no long runs, {error} is missing") from error


def stops(config: Config) -> list[int]:
    """After how many revolutions a long run is judged: as in the study, as in its confirmation, and later."""
    settings, last = config.analysis.divergence, config.long_runs.revolutions
    first = {config.solver.revolutions, settings.confirmation_revolutions} - {0}
    doubled = [last // 2**halvings for halvings in range(3) if last // 2**halvings > max(first)]
    return sorted({*(n for n in first if n <= last), *doubled, last})


def verdict_after(config: Config, amplitude: np.ndarray, revolutions: int) -> tuple[str, Verdict]:
    """Judge the first `revolutions` of a long run; ``free``: the vibration has died out (`DIED_OUT`)."""
    settings, history = config.analysis.divergence, amplitude[:revolutions]
    status = "completed" if np.isfinite(history).all() else "unbounded"
    verdict = judge(history, status, settings)
    if status == "unbounded":
        return status, verdict
    if verdict.divergent:
        return "divergent", verdict
    if history[-1] < DIED_OUT * history.max():
        return "free", verdict
    grew = verdict.growth.grows or growth(amplitude[: config.solver.revolutions], settings).grows
    return ("saturating" if grew else "steady"), verdict


def table(config: Config, coatings: Iterable[LongRuns]) -> pd.DataFrame:
    """Judge long runs after each of `stops`; ``max_wear`` and ``status`` are of the whole run."""
    last, rows = config.analysis.divergence.revolutions, []
    for long in coatings:
        for index, revolutions in itertools.product(range(long.f_omega.size), stops(config)):
            run = {name: getattr(long, name)[index] for name in ("f_omega", "why", "max_wear", "status")}
            amplitude, seconds = long.revolution_amplitude[index], long.seconds[index, :revolutions]
            run["verdict"], verdict = verdict_after(config, amplitude, revolutions)
            seconds, amplitude = seconds[np.isfinite(seconds)], amplitude[:revolutions]
            amplitude = amplitude[np.isfinite(amplitude)]
            run["growth_per_revolution"] = verdict.growth.per_revolution
            run["late_amplitude"] = amplitude[-last:].mean() if amplitude.size else np.nan
            run["ms_per_revolution"] = 1e3 * seconds[-1] / seconds.size if seconds.size else np.nan
            rows.append(asdict(long.case) | run | {"revolutions": revolutions})
    return with_variant(pd.DataFrame(rows), COLUMNS)
