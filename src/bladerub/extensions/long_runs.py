"""Runs of hundreds of revolutions: what becomes of the runs that still grew, and of the peaks."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.run import kernel_warm_up, simulate
from bladerub.io import hdf5
from bladerub.io.errors import DamagedFile
from bladerub.io.hdf5 import Variable
from bladerub.io.provenance import provenance
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.growth import Verdict, growth, judge
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import peak

COLUMNS = [
    "casing",
    "E",
    "K",
    "theta",
    "f_omega",
    "why",
    "revolutions",
    "verdict",
    "growth_per_revolution",
    "late_amplitude",
    "max_wear",
    "status",
    "ms_per_revolution",
    "law",
]
"""Columns of ``long_runs.csv``: a row per run and number of revolutions after which it is judged;
``max_wear`` and ``status`` are of the whole run."""


DIED_OUT = 0.01
"""Part of the greatest amplitude below which a vibration has died out."""


@dataclass(frozen=True)
class LongRuns:
    """The long runs of one coating.

    Parameters
    ----------
    case : CoatingCase
        The coating.
    f_omega : (n,) ndarray
        Their speeds, normalised.
    why : (n,) ndarray of str
        ``grows``, or the peak they are of: ``f4``.
    revolution_amplitude : (n, r) ndarray
        Half the range of the radial displacement of node 1 in each revolution, m; NaN after an unbounded end.
    max_wear : (n,) ndarray
        Greatest worn depth, m.
    status : (n,) ndarray of str
        ``completed`` or ``unbounded``.
    seconds : (n, r) ndarray
        Wall time until the end of each revolution; NaN likewise.
    """

    case: CoatingCase
    f_omega: np.ndarray
    why: np.ndarray
    revolution_amplitude: np.ndarray
    max_wear: np.ndarray
    status: np.ndarray
    seconds: np.ndarray


def chosen(config: Mapping[str, Any], coating: CoatingMap) -> dict[float, str]:
    """Choose the runs of a coating that are worth a long one: by speed, why.

    These are its peaks, and the runs that still grow at the end of the longest that the study made of them.
    Those that left all bounds have come to their end.
    """
    analysis = config["analysis"]
    reasons = {peak(coating, order, analysis["peaks"]).f_omega: f"f{order:g}" for order in _orders(config)}
    verdicts = map(
        judge,
        coating.revolution_amplitude,
        coating.status,
        [analysis["divergence"]] * coating.f_omega.size,
        coating.confirmation_amplitude,
    )
    for f_omega, verdict in zip(coating.f_omega, verdicts, strict=True):
        if verdict.divergent and verdict.status == "completed":
            reasons.setdefault(float(f_omega), "grows")
    return dict(sorted(reasons.items()))


def _orders(config: Mapping[str, Any]) -> list[float]:
    return config["analysis"]["peaks"]["orders"]


def make(
    config: Mapping[str, Any],
    coating: CoatingMap,
    blade: ReducedBlade,
    path: str | Path,
    report: Callable[[str], None],
) -> None:
    """Compute the long runs of one coating and write them to `path`.

    Parameters
    ----------
    config : mapping
        The study; ``long_runs.revolutions`` is their length.
    coating : CoatingMap
        The coating at all speeds.
    blade : ReducedBlade
        The blade.
    path : path-like
        The HDF5 file.
    report : callable
        Called with a line after each run.
    """
    kernel_warm_up()  # or the first run would be charged with loading the machine code
    case, revolutions = coating.case, config["long_runs"]["revolutions"]
    reasons = chosen(config, coating)
    results, seconds = [], np.full((len(reasons), revolutions), np.nan)
    for elapsed, (f_omega, why) in zip(seconds, reasons.items(), strict=True):
        spec = replace(run_spec(config, case, f_omega), revolutions=revolutions)
        results.append(simulate(blade, spec, _watch(elapsed)))
        report(f"{f_omega:.4f} ({why}): {results[-1].message}")
    variables = {
        "f_omega": Variable(("run",), np.array(list(reasons)), "1", "rotational frequency, normalised"),
        "why": Variable(("run",), np.array(list(reasons.values())), "1", "why it was made"),
        "revolution_number": Variable(
            ("revolution_number",), np.arange(1, revolutions + 1), "1", "revolution, counted from 1"
        ),
        "revolution_amplitude": Variable(
            ("run", "revolution_number"),
            np.stack([result.revolution_amplitude for result in results]),
            "m",
            "half the range of the radial displacement of node 1 in each revolution",
        ),
        "max_wear": Variable(
            ("run",), np.array([result.wear.max() for result in results]), "m", "greatest worn depth"
        ),
        "status": Variable(
            ("run",), np.array([result.status for result in results]), "1", "completed or unbounded"
        ),
        "seconds": Variable(
            ("run", "revolution_number"), seconds, "s", "wall time until the end of each revolution"
        ),
    }
    hdf5.write(path, variables, asdict(case), provenance(config))


def _watch(elapsed: np.ndarray) -> Callable[[int], None]:
    """Fill `elapsed` (r,) with the wall time until the end of each revolution, s."""
    start = time.perf_counter()

    def note(done: int) -> None:
        elapsed[done - 1] = time.perf_counter() - start

    return note


def read(path: str | Path) -> LongRuns:
    """Read what `make` has written.

    Raises
    ------
    OSError
        If the file is missing, damaged or another; the message names it.
    """
    data, about = hdf5.read(path)
    names = ("f_omega", "why", "revolution_amplitude", "max_wear", "status", "seconds")
    try:
        return LongRuns(CoatingCase.described(about), *(data[name] for name in names))
    except KeyError as error:
        raise DamagedFile(f"{path}: no long runs, {error} is missing") from error


def stops(config: Mapping[str, Any]) -> list[int]:
    """After how many revolutions a long run is judged: those of the study, of its confirmation, and on."""
    settings, last = config["analysis"]["divergence"], config["long_runs"]["revolutions"]
    first = {config["solver"]["revolutions"], settings["confirmation_revolutions"]} - {0}
    doubled = [last // 2**halvings for halvings in range(3) if last // 2**halvings > max(first)]
    return sorted({*(n for n in first if n <= last), *doubled, last})


def verdict_after(config: Mapping[str, Any], amplitude: np.ndarray, revolutions: int) -> tuple[str, Verdict]:
    """Judge the first `revolutions` of a long run.

    It is ``unbounded``, ``divergent``, ``free`` if the vibration has died out because the blade has worn its
    way free (`DIED_OUT`), ``saturating`` if it grew in the revolutions of the study and does not any more, or
    ``steady``.
    """
    settings, whole = config["analysis"]["divergence"], amplitude[:revolutions]
    status = "completed" if np.isfinite(whole).all() else "unbounded"
    verdict = judge(whole, status, settings)
    if status == "unbounded":
        return status, verdict
    if verdict.divergent:
        return "divergent", verdict
    if whole[-1] < DIED_OUT * whole.max():
        return "free", verdict
    grew = verdict.growth.grows or growth(amplitude[: config["solver"]["revolutions"]], settings).grows
    return ("saturating" if grew else "steady"), verdict


def table(config: Mapping[str, Any], coatings: Iterable[LongRuns]) -> pd.DataFrame:
    """Judge long runs after more and more of their revolutions.

    Returns
    -------
    DataFrame
        With `COLUMNS`.
    """
    last = config["analysis"]["divergence"]["revolutions"]
    rows = []
    for long in coatings:
        case = long.case
        for index, (f_omega, amplitude) in enumerate(
            zip(long.f_omega, long.revolution_amplitude, strict=True)
        ):
            for revolutions in stops(config):
                name, verdict = verdict_after(config, amplitude, revolutions)
                made = np.flatnonzero(np.isfinite(long.seconds[index, :revolutions]))
                late = amplitude[made[-last:]].mean() if made.size else np.nan
                cost = 1e3 * long.seconds[index, made[-1]] / made.size if made.size else np.nan
                rows.append(
                    (
                        *(case.casing, case.E, case.K, case.theta, f_omega, long.why[index], revolutions),
                        *(name, verdict.growth.per_revolution, late),
                        *(long.max_wear[index], long.status[index], cost, case.law),
                    )
                )
    return pd.DataFrame(rows, columns=COLUMNS)
