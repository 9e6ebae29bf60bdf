"""One kind of job: the small study of each of some sets of inputs, its verdicts and measures."""

import itertools
import math
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from threadpoolctl import threadpool_limits

from bladerub.blade.build import build
from bladerub.blade.built import write
from bladerub.blade.cache import kept_at
from bladerub.blade.files import accuracy_path
from bladerub.config import read as configuration
from bladerub.config.errors import ConfigError
from bladerub.config.files import Located
from bladerub.extras.small_study import conduct
from bladerub.extras.variations.plan import Job, Part, Plan
from bladerub.extras.variations.targets import measure
from bladerub.extras.variations.waves import known
from bladerub.io import lock, tables
from bladerub.io.provenance import config_digest, provenance
from bladerub.settings.study import Config, typed
from bladerub.study.grid import coating_cases, speeds

VERDICTS = ["set", "id", "claim", "paper", "measured", "unit", "holds", "margin"]
"""Columns of the verdicts."""

_DETERMINING = ("blade", "reduction", "contact", "coatings", "speeds", "solver", "analysis")  # and casings


class Case(NamedTuple):
    """One small study: the config of one set of inputs and one part."""

    set: str | int
    part: Part
    config: Located  # values not checked

    def checked(self) -> Config:
        """Return the config; raises `ConfigError` if the values make no study together."""
        is_listed = self.set == self.part.name
        name = self.part.name if is_listed else f"parts.{self.part.name}, set {self.set}"
        return configuration.validate(self.config, name)


def cases(
    study: Config, plan: Plan, job: Job, positions: Mapping[str | int, np.ndarray | None] | None = None
) -> list[Case]:
    """Make the config of each small study of a job, from the `study` that is varied.

    `positions` (d,) are by set, None for the study's own values; by default they are those of the plan.
    """
    if positions is None:
        positions = dict.fromkeys(job.sets) | known(plan)
    small_studies = []
    for name, part in itertools.product(job.sets, job.parts):
        if name in positions:
            config = configuration.vary(study, *part.study)
            if positions[name] is not None:
                config = plan.lay_over(config, positions[name])
            small_studies.append(Case(name, part, config))
    return small_studies


# Threads take longer than the splines of a blade's sections
@threadpool_limits.wrap(limits=1, user_api="blas")
def check(study: Config, plan: Plan) -> None:
    """Raise `ConfigError` for sets that make no study: all that are listed, or the first that is drawn."""
    jobs, positions = plan.jobs().values(), None
    if plan.candidates:
        positions = dict(enumerate(plan.listed(study)))
        jobs = [Job(tuple(positions), (*plan.parts.values(), plan.finer))]
    problems = []
    for job in jobs:
        for case in cases(study, plan, job, positions):
            try:
                case.checked()
            except ConfigError as error:
                if plan.factors:
                    raise
                problems += error.problems
    if problems:
        raise ConfigError(problems)


def determinants(study: Config, plan: Plan, job: Job) -> list[Any]:
    """Return what determines the results of a job but code: a change is a reason to run it."""
    small_studies = cases(study, plan, job)
    digests = [(case.set, case.part.claims, digest(typed(case.config.plain()))) for case in small_studies]
    return digests if known(plan) else [*digests, *plan.ranges]  # sets not drawn yet have the study's values


def digest(config: Config) -> str:
    """Digest those parts of its config that determine what a small study shows."""
    used = {case.casing for case in coating_cases(config)}
    values = config.plain()
    casings = {name: values["casings"][name] for name in sorted(used)}
    return config_digest({key: values[key] for key in _DETERMINING} | {"casings": casings})


def minutes(study: Config, plan: Plan, job: Job) -> int:
    """Return the time to ask a cluster for: a minute a set, and three times what the revolutions took."""
    revolutions = 0.0
    for case in cases(study, plan, job):
        config = typed(case.config.plain())
        runs = len(coating_cases(config)) * len(speeds(config))
        scale = config.contact.elements / study.contact.elements
        revolutions += runs * config.solver.revolutions * scale
    return math.ceil(1 + len(job.sets) + 0.03 * revolutions / 60)


def judge(
    cases: Iterable[Case],
    blades: str | Path,
    folder: str | Path | None = None,
    report: Callable[[object], None] = lambda line: None,
) -> dict[str, pd.DataFrame]:
    """Make the small study of each case, judge the claims of its part and measure their targets.

    Tables ``verdicts``, ``quantities`` (NaN where nothing is measured) and ``cost`` (without the blade). Each
    blade is built once, in a folder of `blades`. `folder`, for the only case, keeps runs and maps.
    """
    verdicts, quantities, cost = [], [], []
    for case in cases:
        config = case.checked()
        model = blade_of(config, blades, report)
        start = time.process_time()
        study = conduct(config, model, accuracy_path(model), folder, case.part.claims, report)
        cost.append((case.part.name, case.set, study.n_runs, time.process_time() - start))
        verdicts.append(study.findings.assign(set=case.set)[VERDICTS])
        if case.part.claims:
            measured = measure(study.evidence, case.part.claims)
            quantities += [(case.set, name, value) for name, value in measured.items()]
        for name in ("peaks", "divergence") if folder else ():
            path, origin = Path(folder) / "tables" / f"{name}.csv", provenance(config.plain())
            tables.write(path, getattr(study, name), origin)
    return {
        "verdicts": pd.concat(verdicts, ignore_index=True),
        "quantities": pd.DataFrame(quantities, columns=["set", "target", "value"]),
        "cost": pd.DataFrame(cost, columns=["part", "set", "runs", "cpu_s"]),
    }


def blade_of(config: Config, blades: str | Path, report: Callable[[object], None]) -> Path:
    """Return the file of the reduced blade of `config`, in a folder of `blades`; built if it is not there."""
    folder = Path(blades) / kept_at(config).parent.name
    model = folder / "reduced_model.h5"
    with lock.held(folder / ".lock", lambda: report(f"another job builds the blade in {folder}")):
        if not model.exists():
            write(build(config), provenance(config.plain()), model)
    return model


def read(paths: Iterable[str | Path], columns: Sequence[str] = ()) -> pd.DataFrame:
    """Read a table of several jobs as one, with at least these columns; raises as `tables.read`."""
    jobs = [tables.read(path, columns) for path in paths]
    return pd.concat([job for job in jobs if len(job)] or jobs[:1], ignore_index=True)
