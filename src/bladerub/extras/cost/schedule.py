"""How long a study takes on so many cores: its schedule, simulated from measured times of its jobs."""

import heapq
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from bladerub.workflow.cores import BEGUN, costs_of, priority_of, threads_for

CORES = (1, 2, 4, 8, 16, 32, 64)
COLUMNS = ["cores", "minutes", "efficiency"]
_CHAIN = ("rubs", "ensembles")  # of each coating, one after the other
_FIRST = ("blade", "compilation")


def table(costs: pd.DataFrame, config: Mapping[str, Any], cores: Sequence[int] = CORES) -> pd.DataFrame:
    """Simulate the schedule of the jobs of `costs`, of `bladerub.extras.cost.jobs`, on so many `cores`.

    Every core works as fast as that which the jobs were measured on, and so does each thread of a job. Blade
    and kernel come first; then each coating has its runs and its ensembles, those begun before the
    runs of others, and of these the longest; all else comes last. Returns a row for each number of cores,
    with `COLUMNS`: the minutes, and the time of all jobs over that of all cores.
    """
    chained = costs.stage.isin(_CHAIN)
    jobs = {(job.stage, job.job): job.wall_s for job in costs[chained].itertuples()}
    first = costs[costs.stage.isin(_FIRST)].wall_s.max()
    last = costs[~chained & ~costs.stage.isin(_FIRST)].wall_s.sort_values(ascending=False)
    expected = costs_of(config)
    priority = {coating: priority_of(coating, expected) for coating in expected.runs}
    total, job_time, rows = expected.total, costs.wall_s.sum(), []
    for n in cores:
        threads = dict.fromkeys(jobs, 1)
        for stage, of_stage in (("rubs", expected.runs), ("ensembles", expected.ensembles)):
            threads |= {(stage, coating): threads_for(cost, total, n) for coating, cost in of_stage.items()}
        took = first + _chains(jobs, threads, priority, n) + _in_turn(last, n)
        rows.append((n, took / 60, job_time / n / took))
    return pd.DataFrame(rows, columns=COLUMNS)


def _chains(
    jobs: Mapping[tuple[str, str], float],
    threads: Mapping[tuple[str, str], int],
    priority: Mapping[str, float],
    cores: int,
) -> float:
    """Time of the jobs of all coatings, s; those of a coating that has begun come first."""
    queue = [(-priority[coating], coating, stage) for stage, coating in jobs if stage == _CHAIN[0]]
    at_work: list[tuple[float, str, str]] = []
    clock, free = 0.0, cores
    while queue or at_work:
        for job in sorted(queue):
            _, coating, stage = job
            if threads[stage, coating] <= free:
                free -= threads[stage, coating]
                queue.remove(job)
                end = clock + jobs[stage, coating] / threads[stage, coating]
                heapq.heappush(at_work, (end, coating, stage))
        clock, coating, stage = heapq.heappop(at_work)
        free += threads[stage, coating]
        following = [
            successor for successor in _CHAIN[_CHAIN.index(stage) + 1 :] if (successor, coating) in jobs
        ]
        queue += [(-BEGUN, coating, successor) for successor in following[:1]]
    return clock


def _in_turn(seconds: Sequence[float], cores: int) -> float:
    """Time of jobs that do not wait for each other, each on the core that is free first, s."""
    ends = [0.0] * cores
    for time in seconds:
        heapq.heapreplace(ends, ends[0] + time)
    return max(ends)
