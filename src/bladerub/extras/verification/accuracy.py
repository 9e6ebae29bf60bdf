"""The errors of runs drawn from the study: a table with a row for each run, and their distribution."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, astuple
from typing import Any

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.extras.verification.differences import Differences
from bladerub.extras.verification.verify import TOLERANCE, StudyRun, VerifiedRun, draw, verify_runs
from bladerub.io.values import plain
from bladerub.settings.study import Config
from bladerub.study.variants import with_variant

DRAWS = {"all": [(1, 40), (2, 40), (3, 40)], "important": [(1, 100)]}
"""Seeds of the draws and numbers of runs, from all of the study and from those that claims rest on."""

COLUMNS = [
    *("drawn_from", "seed", "casing", "E", "K", "theta", "law", "f_omega", "status"),
    *(f"error_{measure}" for measure in Differences._fields),
    *(f"start_{measure}" for measure in Differences._fields),
    *("sensitive", "energy_residual", "speedup_at_equal_error", "cpu_s"),
]
"""Columns of ``accuracy.csv``, described in ``columns.csv``."""


def table(
    blade: ReducedBlade,
    config: Config,
    candidates: Mapping[str, Sequence[StudyRun]],
    report: Callable[[object], None] = lambda line: None,
) -> pd.DataFrame:
    """Verify the runs of `DRAWS` (`bladerub.extras.verification.verify`); a row each, with `COLUMNS`.

    `candidates` are the runs to draw from by the names there; of a study that has fewer all are taken.
    `report` is called with a line for a log after each run.
    """
    rows = []
    for name, draws in DRAWS.items():
        for seed, sample in draws:
            runs = draw(candidates[name], min(sample, len(candidates[name])), seed)
            for number, verified in enumerate(verify_runs(blade, config, runs), 1):
                rows.append([name, seed, *_cells(verified)])
                report(f"{name}, seed {seed}: {number} of {len(runs)}, {verified.run.name}")
    return with_variant(pd.DataFrame(rows, columns=[*COLUMNS, "variant"]), COLUMNS)


def _cells(verified: VerifiedRun) -> list[Any]:
    *coating, variant = astuple(verified.run.case)
    return [
        *(*coating, verified.run.f_omega, verified.status, *verified.error),
        *(verified.spread or (None,) * len(Differences._fields)),
        *(verified.is_sensitive, verified.energy_residual, verified.speedup, verified.seconds["study"]),
        variant,
    ]


def summary(verified: Sequence[VerifiedRun]) -> dict[str, Any]:
    """Summarise the errors of one run or more, in plain values that JSON can hold; infinite ones are None.

    The keys are those that docs/how-to/how_sure.md describes; ``speedup_at_equal_error`` is the median over
    the runs that have one and are not sensitive, and of the runs ``beyond`` the worst comes first.
    """
    within = [max(run.error.wear_l2, run.error.peak) <= TOLERANCE for run in verified]
    speedups = [run.speedup for run in verified if run.speedup is not None and not run.is_sensitive]
    beyond = sorted((run for run in verified if run.is_beyond), key=lambda run: -max(run.error))
    figures = {
        "n": len(verified),
        "within_1_percent": np.mean(within),
        **_distributions([run.error for run in verified]),
        "energy_residual": _distribution([run.energy_residual for run in verified]),
        "worst": {
            measure: max(verified, key=lambda run: getattr(run.error, measure)).run.name
            for measure in Differences._fields
        },
        "against_paper_scheme": _distributions([run.against_paper for run in verified])
        | {"uncertainty": _distributions([run.paper_uncertainty for run in verified])},
        "speedup_at_equal_error": np.median(speedups) if speedups else None,
        "left_out": len(verified) - len(speedups),
        "seconds": pd.DataFrame([run.seconds for run in verified]).mean().to_dict(),
        "beyond": [_entry(run) for run in beyond],
    }
    return plain(figures)


def _distribution(values: Sequence[float]) -> dict[str, float]:
    """Median, smallest value that at least 95 % of the values do not exceed, and maximum."""
    p95 = np.quantile(values, 0.95, method="inverted_cdf")
    return {"median": np.median(values), "p95": p95, "max": max(values)}


def _distributions(several: Sequence[Differences]) -> dict[str, Any]:
    return {measure: _distribution(values) for measure, values in pd.DataFrame(several).items()}


def _entry(verified: VerifiedRun) -> dict[str, Any]:
    return {
        "name": verified.run.name,
        **asdict(verified.run.case),
        "f_omega": verified.run.f_omega,
        "status": verified.status,
        **verified.error._asdict(),
        "spread": verified.spread and verified.spread._asdict(),
        "sensitive": verified.is_sensitive,
    }
