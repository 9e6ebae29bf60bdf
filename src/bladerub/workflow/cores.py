"""How the cores of a machine are divided among the jobs of a study."""

import math
from collections.abc import Mapping
from typing import Any

from bladerub.study.grid import coating_cases, speeds
from bladerub.study.members import expected_members

FEWEST = 8
"""Jobs that a core should have to do, at least: the last ones then end at nearly the same time."""

ON_RIGID_CASING = 4
"""Time of a run on the rigid casing over that of one on a coating, about (`docs/data/cost.csv`)."""


def threads_for(cost: float, total: float, cores: int | None) -> int:
    """Threads of a job that has `cost` of the `total` of all jobs, on so many `cores` (None: not known).

    One, unless the job is a large part of what a core has to do: it would end long after all others.
    """
    if not cores:
        return 1
    return max(1, min(cores, math.ceil(FEWEST * cost / total * cores - 1)))


def priority_of(coating: str, costs: Mapping[str, tuple[int, int]]) -> float:
    """Priority, below 1, of the runs of a `coating`: the more it and what follows cost, the higher.

    Those that take longest so come first and none of them is left at the end, with the other cores idle.
    Zero for a coating that `costs`, those of `costs_of`, do not have.
    """
    return sum(costs.get(coating, ())) / (1 + sum(map(sum, costs.values())))


def costs_of(config: Mapping[str, Any]) -> dict[str, tuple[int, int]]:
    """Estimate what runs and ensembles of each coating of a study cost, in runs on a coating, by its name."""
    n_speeds = len(speeds(config))
    return {
        case.name: (weight * n_speeds, weight * expected_members(config, case))
        for case in coating_cases(config)
        for weight in [ON_RIGID_CASING if case.is_rigid else 1]
    }
