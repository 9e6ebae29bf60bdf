"""What is said of a plan: how many runs of the study are to be computed, and about how long its jobs take."""

import atexit
import sys
import textwrap
from collections.abc import Callable, Collection, Iterable
from pathlib import Path
from typing import Any

from bladerub.extras import inventory
from bladerub.extras.cores import GROWING, SECONDS_AT_FIRST, SECONDS_PER_JOB, SECONDS_PER_REVOLUTION, costs_of
from bladerub.io.errors import message_for
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases
from bladerub.study.plan import CoatingPlan, coating_plan


def announce(
    config: Config,
    workflow: Any,
    cores: int | None = None,
    plan_of: Callable[[str], CoatingPlan] | None = None,
) -> None:
    """Print the `forecast` of the jobs that Snakemake's `workflow` is to do, unless it has failed before."""
    if workflow.dag is None:  # there was an error
        return
    planned = list(workflow.dag.needrun_jobs(exclude_finished=False))  # to a dry run all are finished
    names, known = (rule.name for rule in workflow.rules), "compile_kernel"
    # what `use rule * from … as` puts before each name
    prefix = next((name for name in names if name.endswith(known)), known).removesuffix(known)
    jobs = [(job.rule.name.removeprefix(prefix), job.wildcards.get("coating")) for job in planned]
    # what simulates waits for the machine code
    simulating = {rule for job, (rule, _) in zip(planned, jobs, strict=True) if hasattr(job.input, "kernel")}
    try:
        line = forecast(config, jobs, cores, plan_of, simulating)
    except OSError as error:
        line = message_for(error)
    names = [case.name for case in coating_cases(config)]  # so that a list such as [0,5] shows as two values
    coatings = f"{len(names)} coatings: {textwrap.shorten(', '.join(names), 160, placeholder=' …')}"
    print(f"bladerub: {coatings}\nbladerub: {line}", file=sys.stderr)


def announce_at_exit(config: Config, workflow: Any) -> None:
    """Print the `forecast` after the jobs that a dry run lists."""
    atexit.register(announce, config, workflow)


def forecast(
    config: Config,
    jobs: Iterable[tuple[str, str | None]],
    cores: int | None = None,
    plan_of: Callable[[str], CoatingPlan] | None = None,
    simulating: Collection[str] = (),
) -> str:
    """Say in a line how many runs of the study are missing, stale or corrupt, and what the `jobs` cost.

    These are pairs of rule and coating. Without `cores`, of which Snakemake tells a dry run nothing, the time
    is that of one. Of the `simulating` rules those whose time is not known are named.
    """
    results, jobs = Path(config.results), list(jobs)
    digest, _ = inventory.current_blade(config, results / "blade" / "reduced_model.h5")
    counts = {}
    for case in coating_cases(config):
        plan = plan_of(case.name) if plan_of else coating_plan(config, case)
        counts[case.name] = inventory.take(config, plan, results / "runs" / case.name, digest)[0]
    total = inventory.total(counts.values())
    missing = {name: count["planned"] - count["done"] for name, count in counts.items()}
    asked = {coating for rule, coating in jobs if rule == "coating"}
    n_runs, state = sum(missing.values()), "missing, and not asked for"
    if any(missing[name] for name in asked & missing.keys()):
        n_runs, state = sum(missing[name] for name in asked & missing.keys()), "to be computed"
    planned = f"{total['planned']:,} runs of the study are"
    runs = f"{n_runs:,} of {planned} {state}" if n_runs else f"all {planned} done"
    if further := len(asked - missing.keys()):
        runs += f", and those of {further} coating{'s' * (further > 1)} beside it are asked for"
    if digest and total["done"] and "blade" in dict(jobs):
        runs += ", if the blade comes out as it is"
    if not jobs:
        return runs
    costs, row = costs_of(config), config.plugged("rotor")
    mean = sum(costs.runs.values()) / len(costs.runs)
    simulated = seconds = 0.0
    left = {name: 1 - count["done"] / count["planned"] for name, count in counts.items()}
    for rule, coating in jobs:
        seconds += SECONDS_PER_JOB + SECONDS_AT_FIRST.get(rule, 0)
        if rule == "coating":
            simulated += left.get(coating, 1) * (row.blades if row else 1) * costs.runs.get(coating, mean)
        elif rule in costs.further:  # of a coating whose own runs are done, what was listed once is too
            is_listed = (results / "runs" / str(coating) / rule / "manifest.tsv").exists()
            simulated += 0 if is_listed and not left.get(coating, 1) else costs.further[rule].get(coating, 0)
    revolutions = config.solver.revolutions
    longer = max(config.analysis.divergence.confirmation_revolutions - revolutions, 0)
    seconds += simulated * (revolutions + GROWING * longer) * SECONDS_PER_REVOLUTION
    minutes = max(seconds / 60 / (cores or 1), 1)
    machine = f"on {cores} cores" if cores and cores > 1 else "of one core"
    unknown = sorted(set(simulating) - {"coating", *costs.further})
    without = f", without the simulations of {', '.join(unknown)}" if unknown else ""
    number = "1 job" if len(jobs) == 1 else f"{len(jobs):,} jobs"
    return f"{runs}; {number}, about {minutes:.0f} min {machine}{without}"
