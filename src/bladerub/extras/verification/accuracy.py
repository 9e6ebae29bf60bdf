"""The errors of runs drawn from the study, as a table: a row for each run."""

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.extras.verification.differences import Differences
from bladerub.extras.verification.response import CASE_COLUMNS
from bladerub.extras.verification.verify import StudyRun, VerifiedRun, draw, verify_runs
from bladerub.settings.study import Config

DRAWS = {"all": [(1, 40), (2, 40), (3, 40)], "important": [(1, 100)]}
"""Seeds of the draws and numbers of runs, from all of the study and from those that claims rest on."""

COLUMNS = [
    *("drawn_from", "seed", *CASE_COLUMNS, "law", "f_omega", "status"),
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
    return pd.DataFrame(rows, columns=COLUMNS)


def _cells(verified: VerifiedRun) -> list[Any]:
    case, spread = verified.run.case, verified.spread or (None,) * len(Differences._fields)
    return [
        *(getattr(case, name) for name in (*CASE_COLUMNS, "law")),
        *(verified.run.f_omega, verified.status, *verified.error, *spread),
        *(verified.is_sensitive, verified.energy_residual, verified.speedup, verified.seconds.study),
    ]
