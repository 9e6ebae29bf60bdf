"""One set of values: its blade, a small study for each part of the plan, its targets and its verdicts."""

import tempfile
import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.blade.files import accuracy_path, mesh_path
from bladerub.config.files import Located
from bladerub.extras.identification.plan import Plan, config_of
from bladerub.extras.identification.targets import measure
from bladerub.extras.small_study import SmallStudy, conduct
from bladerub.io.provenance import config_digest, provenance

QUANTITIES = ["set", "target", "value"]
"""Columns of the measured targets; NaN where a study has nothing to measure."""

VERDICTS = ["set", "id", "holds", "margin"]
"""Columns of the verdicts."""

COST = ["set", "runs", "cpu_s"]
"""Columns of the cost: runs, and processor time in s."""


class Simulated(NamedTuple):
    """What some sets show: tables with `QUANTITIES`, `VERDICTS` and `COST`."""

    quantities: pd.DataFrame
    verdicts: pd.DataFrame
    cost: pd.DataFrame


def simulate(study: Mapping[str, Any], plan: Plan, positions: Mapping[int, np.ndarray]) -> Simulated:
    """Simulate sets, given by number and position (d,) in the ranges of the factors.

    Raises `ConfigError` if the values of a set make no study together.
    """
    quantities, verdicts, cost = [], [], []
    for number, position in positions.items():
        start, n_runs = time.process_time(), 0
        for part in plan.parts.values():
            result = conduct_set(study, plan, part.study, position, part.claims)
            values = measure(result.evidence, part.claims)
            quantities += [(number, name, value) for name, value in values.items()]
            verdicts.append(result.findings.assign(set=number)[VERDICTS])
            n_runs += result.n_runs
        cost.append((number, n_runs, time.process_time() - start))
    return Simulated(
        pd.DataFrame(quantities, columns=QUANTITIES),
        pd.concat(verdicts, ignore_index=True),
        pd.DataFrame(cost, columns=COST),
    )


def check(study: Mapping[str, Any], plan: Plan) -> None:
    """Check the study's own and the given sets with every part, and the candidates' study.

    Raises `ConfigError` if the values of one make no study together.
    """
    for position in plan.given(study):
        for variation in (*(part.study for part in plan.parts.values()), plan.candidates.study):
            config_of(study, plan, variation, position)


def determinants(study: Mapping[str, Any], plan: Plan) -> dict[str, Any]:
    """Return what determines the results of a set at given positions, of the plan and of the study."""
    settings = {key: study[key] for key in ("blade", "reduction", "contact", "casings", "solver", "analysis")}
    parts = {name: (part.claims, part.study.plain()) for name, part in plan.parts.items()}
    return {
        "study": config_digest(settings),
        "factors": [(f.name, f.ranges) for f in plan.factors],
        "parts": parts,
    }


def conduct_set(
    study: Mapping[str, Any],
    plan: Plan,
    variation: Located,
    position: np.ndarray,
    claims: tuple[str, ...] | None = None,
) -> SmallStudy:
    """Build the blade of one set, whose files are not kept, and make one small study of it."""
    config = config_of(study, plan, variation, position)
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / "blade" / "reduced_model.h5"
        write(build(config), provenance(config), model, mesh_path(model), accuracy_path(model))
        return conduct(config, model, accuracy_path(model), claims=claims)
