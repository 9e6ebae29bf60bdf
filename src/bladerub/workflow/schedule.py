"""How long a study takes on so many cores: its schedule, simulated from measured times of its jobs."""

import heapq
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from bladerub.workflow.cores import BEGUN, costs_of, priority_of, threads_for

CORES = (1, 2, 4, 8, 16, 32, 64)
COLUMNS = ["cores", "minutes", "efficiency"]
_CHAIN = ("rubs", "maps", "ensembles")  # of each coating, one after the other
_FIRST = ("blade", "compilation")


def table(costs: pd.DataFrame, config: Mapping[str, Any], cores: Sequence[int] = CORES) -> pd.DataFrame:
    """Simulate the schedule of the jobs of `costs`, a table of `bladerub.workflow.cost`, on so many `cores`.

    Every core works as fast as that which the jobs were measured on, and so does each thread of a job. Blade
    and kernel come first; then each coating has its runs, its map and its ensembles, those begun before the
    runs of others, and of these the longest; all else comes last. Returns a row for each number of cores,
    with `COLUMNS`: the minutes, and the time of all jobs over that of all cores.
    """
    chained = costs.stage.isin(_CHAIN)
    jobs = {(job.stage, job.job): job.wall_s for job in costs[chained].itertuples()}
    first = costs[costs.stage.isin(_FIRST)].wall_s.max()
    last = costs[~chained & ~costs.stage.isin(_FIRST)].wall_s.sort_values(ascending=False)
    expected = costs_of(config)
    priority = {coating: priority_of(coating, expected) for coating in expected.runs}
    total, whole, rows = expected.total, costs.wall_s.sum(), []
    for n in cores:
        threads = dict.fromkeys(jobs, 1)
        for stage, of_stage in (("rubs", expected.runs), ("ensembles", expected.ensembles)):
            threads |= {(stage, coating): threads_for(of, total, n) for coating, of in of_stage.items()}
        took = first + _chains(jobs, threads, priority, n) + _in_turn(last, n)
        rows.append((n, took / 60, whole / n / took))
    return pd.DataFrame(rows, columns=COLUMNS)


def _chains(
    jobs: Mapping[tuple[str, str], float],
    threads: Mapping[tuple[str, str], int],
    priority: Mapping[str, float],
    cores: int,
) -> float:
    """Time of the jobs of all coatings, s; those of a coating that has begun come first."""
    waiting = [(-priority[coating], coating, stage) for stage, coating in jobs if stage == _CHAIN[0]]
    at_work: list[tuple[float, str, str]] = []
    now, free = 0.0, cores
    while waiting or at_work:
        for job in sorted(waiting):
            _, coating, stage = job
            if threads[stage, coating] <= free:
                free -= threads[stage, coating]
                waiting.remove(job)
                end = now + jobs[stage, coating] / threads[stage, coating]
                heapq.heappush(at_work, (end, coating, stage))
        now, coating, stage = heapq.heappop(at_work)
        free += threads[stage, coating]
        following = [after for after in _CHAIN[_CHAIN.index(stage) + 1 :] if (after, coating) in jobs]
        waiting += [(-BEGUN, coating, after) for after in following[:1]]
    return now


def _in_turn(seconds: Sequence[float], cores: int) -> float:
    """Time of jobs that do not wait for each other, each on the core that is free first, s."""
    ends = [0.0] * cores
    for time in seconds:
        heapq.heapreplace(ends, ends[0] + time)
    return max(ends)
