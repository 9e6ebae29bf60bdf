"""The error of each run: the same run with finer steps, with the paper's scheme and from neighbouring starts.

1. *The study's run*: scheme and step of the config.
2. *Its error*: its `Differences` from the same scheme with a step `REFINEMENT` times finer.
3. *The paper's scheme*, at `STABLE_PART` of its largest stable step and at one `REFINEMENT` times finer.
   Being of first order, it has at the finer step an error of its own, ``1 / (REFINEMENT − 1)`` of the
   difference between the two: the uncertainty of a comparison with it.
4. *Sensitive* is a run beyond `TOLERANCE` that neighbouring starts change by at least half as much as a
   finer step does. Its error comes from the run rather than from the solver.
5. A row of blades (`StudyRun.row`) is one run: `bladerub.extras.verification.differences.differences`.
6. *Speed-up at equal error* (`speedup_at_equal_error`): what the paper's scheme would cost at the error of
   the study's run, over what the study's run costs.
"""

import math
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import asdict, astuple, dataclass, replace
from functools import partial
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from bladerub.blade.model import ReducedBlade
from bladerub.contact.modes import modes_at
from bladerub.contact.result import RunResult
from bladerub.contact.run import simulate
from bladerub.contact.setup import compile_kernel
from bladerub.contact.spec import RunSpec
from bladerub.contact.steps import STABLE_PART, with_steps
from bladerub.contact.strips import element_passage
from bladerub.extras.study_runs import StudyRun
from bladerub.extras.verification.differences import Differences, differences, largest
from bladerub.io.values import plain
from bladerub.settings.study import Config
from bladerub.study.grid import element_law, run_spec
from bladerub.study.solver import each_done
from bladerub.study.variants import with_variant

TOLERANCE = 0.01  # differences beyond this are listed by run
REFINEMENT = 4  # the finer step leaves 1/16 of an error of second order, 1/4 of one of first
NEIGHBOURS = (-1e-7, -5e-8, 5e-8, 1e-7)
"""Initial radial displacements of node 1 in neighbouring starts, m: far below the tolerance to which a blade
tip is made (some 0.01 mm) and far above rounding."""
DRAWS = {"all": [(1, 40), (2, 40), (3, 40)], "important": [(1, 100)]}
"""Seeds of the draws and numbers of runs, from all of the study and from those that claims rest on."""
COLUMNS = [  # of ``accuracy.csv``
    *("drawn_from", "seed", "casing", "E", "K", "theta", "law", "f_omega", "status"),
    *(f"error_{measure}" for measure in Differences._fields),
    *(f"start_{measure}" for measure in Differences._fields),
    *("sensitive", "energy_residual", "speedup_at_equal_error", "cpu_s"),
]


class Solved(NamedTuple):
    """Outcome of a run: of its blade, or of each blade of a row."""

    blades: tuple[RunResult, ...]
    energy_residual: float
    seconds: float  # of CPU time


@dataclass(frozen=True)
class VerifiedRun:
    """The error of one run, see the definitions of this module."""

    run: StudyRun
    status: str  # "unbounded" if the run or the one with finer steps is, otherwise "completed"
    error: Differences
    against_paper: Differences  # from the paper's scheme with finer steps
    paper_uncertainty: Differences
    spread: Differences | None  # largest of neighbouring starts; None within tolerance and if unbounded
    energy_residual: float
    seconds: dict[str, float]  # CPU time: study, with finer steps, paper's scheme, that finer
    speedup: float | None  # by wear, or by spectral peak where nothing wears

    @property
    def is_beyond(self) -> bool:
        """Whether any error is beyond `TOLERANCE`."""
        return max(self.error) > TOLERANCE

    @property
    def is_sensitive(self) -> bool:
        """Whether it is beyond, and neighbouring starts explain that, see `explain`."""
        return self.is_beyond and self.spread is not None and explain(self.error, self.spread)


def explain(error: Differences, spread: Differences) -> bool:
    """Whether neighbouring starts change a run by at least half of each `error` beyond `TOLERANCE`."""
    pairs = zip(error, spread, strict=True)
    return all(change >= difference / 2 for difference, change in pairs if difference > TOLERANCE)


def draw(runs: Sequence[StudyRun], sample: int, seed: int) -> list[StudyRun]:
    """Draw `sample` distinct runs, all equally likely; raises `ValueError` if there are fewer."""
    if not 1 <= sample <= len(runs):
        raise ValueError(f"must be from 1 to {len(runs)}, the number of runs to draw from")
    drawn = np.random.default_rng(seed).choice(len(runs), size=sample, replace=False)
    return [runs[index] for index in drawn]


def verify_runs(
    blade: ReducedBlade, config: Config, runs: Sequence[StudyRun], jobs: int = 1
) -> Iterator[VerifiedRun]:
    """Verify `jobs` runs at once, and yield each as it is done; raises as `verify_run`."""
    compile_kernel(bool(config.contact.tip_turns), blade.n_interface, element_law(config))
    yield from (verified for _, verified in each_done(partial(verify_run, blade, config), runs, jobs))


def verify_run(blade: ReducedBlade, config: Config, run: StudyRun) -> VerifiedRun:
    """Find the error of one run; `ValueError` if the blade has no such speed, or the step is too long."""
    spec = run_spec(config, run.case, run.f_omega)
    passage = element_passage(blade, spec)
    solve = partial(_solve, blade, run.row)
    outcome = solve(spec)
    finer = solve(with_steps(spec, REFINEMENT * round(passage / outcome.blades[0].time_step)))
    paper_spec = replace(spec, scheme="central_differences")
    longest = STABLE_PART * 2 / modes_at(blade, spec.f_omega).omega[-1]
    paper_steps = math.ceil(passage / longest)
    paper, paper_finer = (solve(with_steps(paper_spec, n * paper_steps)) for n in (1, REFINEMENT))

    def compare(one: Solved, other: Solved) -> Differences:
        return differences(one.blades, other.blades, config.analysis)

    error, spread = compare(outcome, finer), None
    if max(error) > TOLERANCE and outcome.blades[0].status == "completed":
        starts = (replace(spec, initial_displacement=start) for start in NEIGHBOURS)
        spread = largest(compare(solve(start), outcome) for start in starts)
    measure = Differences._fields.index("wear_l2" if finer.blades[0].wear.any() else "peak")
    unbounded = "unbounded" in (outcome.blades[0].status, finer.blades[0].status)
    solved = {"study": outcome, "finer": finer, "paper": paper, "paper_finer": paper_finer}
    paper_errors = (compare(one, finer)[measure] for one in (paper, paper_finer))
    costs = outcome.seconds, *paper_errors, paper_finer.seconds
    return VerifiedRun(
        run=run,
        status="unbounded" if unbounded else "completed",
        error=error,
        against_paper=compare(outcome, paper_finer),
        paper_uncertainty=Differences(*np.divide(compare(paper, paper_finer), REFINEMENT - 1).tolist()),
        spread=spread,
        energy_residual=outcome.energy_residual,
        seconds={name: run_solved.seconds for name, run_solved in solved.items()},
        speedup=speedup_at_equal_error(error[measure], *costs),
    )


def speedup_at_equal_error(
    error: float, seconds: float, paper_error: float, paper_finer_error: float, paper_finer_seconds: float
) -> float | None:
    """Cost of the paper's scheme at the error of the study's run, over the cost of the study's run.

    All errors are differences from the study's scheme with finer steps. That of the paper's scheme is taken
    as proportional to the step, its cost to 1 / step; its step of equal error is at most its coarser step, as
    stability allows no longer one. None if an error is zero or infinite, or does not decrease with its step.
    """
    errors = (error, paper_error, paper_finer_error)
    if min(errors) == 0 or max(errors) == math.inf or paper_finer_error >= paper_error:
        return None
    step = min(error / paper_finer_error, REFINEMENT)  # in units of the finer step
    return paper_finer_seconds / step / seconds


def _solve(blade: ReducedBlade, row: Any, spec: RunSpec) -> Solved:
    start = time.thread_time()  # other processes and threads do not count
    if row is None:
        result = simulate(blade, spec)
        return Solved((result,), result.energy.residual, time.thread_time() - start)

    from bladerub.extras.rows.row import simulate_row  # single blades do without

    together = simulate_row(blade, spec, row)
    blades = tuple(replace(blade_result, status=together.status) for blade_result in together.blades)
    return Solved(blades, together.residual, time.thread_time() - start)


def table(
    blade: ReducedBlade,
    config: Config,
    candidates: Mapping[str, Sequence[StudyRun]],
    report: Callable[[object], None] = lambda line: None,
) -> pd.DataFrame:
    """Verify the runs of `DRAWS`, or all `candidates` of a name if these are fewer; columns `COLUMNS`."""
    rows = []
    for name, draws in DRAWS.items():
        for seed, sample in draws:
            runs = draw(candidates[name], min(sample, len(candidates[name])), seed)
            for number, verified in enumerate(verify_runs(blade, config, runs), 1):
                *coating, variant = astuple(verified.run.case)
                row = [name, seed, *coating, verified.run.f_omega, verified.status, *verified.error]
                row += verified.spread or (None,) * len(Differences._fields)
                row += [verified.is_sensitive, verified.energy_residual, verified.speedup]
                rows.append([*row, verified.seconds["study"], variant])
                report(f"{name}, seed {seed}: {number} of {len(runs)}, {verified.run.name}")
    return with_variant(pd.DataFrame(rows, columns=[*COLUMNS, "variant"]), COLUMNS)


def summary(verified: Sequence[VerifiedRun]) -> dict[str, Any]:
    """Summarise errors in plain values, by keys of docs/how-to/how_sure.md; infinite ones are None."""
    errors = pd.DataFrame([run.error for run in verified], index=[run.run.name for run in verified])
    speedups = [run.speedup for run in verified if run.speedup is not None and not run.is_sensitive]
    beyond = sorted((run for run in verified if run.is_beyond), key=lambda run: -max(run.error))
    against_paper, uncertainty = (
        pd.DataFrame([getattr(run, name) for run in verified])
        for name in ("against_paper", "paper_uncertainty")
    )
    figures = {
        "n": len(verified),
        "within_1_percent": (errors[["wear_l2", "peak"]].max(axis=1) <= TOLERANCE).mean(),
        **_distributions(errors),
        "energy_residual": _distribution([run.energy_residual for run in verified]),
        "worst": errors.idxmax().to_dict(),
        "against_paper_scheme": _distributions(against_paper) | {"uncertainty": _distributions(uncertainty)},
        "speedup_at_equal_error": np.median(speedups) if speedups else None,
        "left_out": len(verified) - len(speedups),
        "seconds": pd.DataFrame([run.seconds for run in verified]).mean().to_dict(),
        "beyond": [
            {"name": run.run.name, **asdict(run.run.case), "f_omega": run.run.f_omega, "status": run.status}
            | run.error._asdict()
            | {"spread": run.spread and run.spread._asdict(), "sensitive": run.is_sensitive}
            for run in beyond
        ],
    }
    return plain(figures)


def _distribution(values: Sequence[float]) -> dict[str, float]:
    """Median, smallest value that at least 95 % of the values do not exceed, and maximum."""
    p95 = np.quantile(values, 0.95, method="inverted_cdf")
    return {"median": np.median(values), "p95": p95, "max": max(values)}


def _distributions(several: pd.DataFrame) -> dict[str, Any]:
    return {measure: _distribution(values) for measure, values in several.items()}
