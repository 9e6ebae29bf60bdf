"""How the cores of a machine are divided among the jobs of a study."""

import math
from collections.abc import Mapping
from typing import Any

from bladerub.study.grid import coating_cases, speeds
from bladerub.study.members import expected_members

FEWEST = 8
"""Jobs that a core should have to do, at least: the last ones then end at nearly the same time."""


def threads_for(cost: float, total: float, cores: int | None) -> int:
    """Threads of a job that has `cost` of the `total` of all jobs, on so many `cores` (None: not known).

    One, unless the job is a large part of what a core has to do: it would end long after all others.
    """
    if not cores:
        return 1
    return max(1, min(cores, math.ceil(FEWEST * cost / total * cores - 1)))


def sizes(config: Mapping[str, Any]) -> dict[str, tuple[int, int]]:
    """Count the runs and the members of ensembles of each coating of a study, by its name."""
    n_speeds = len(speeds(config))
    return {case.name: (n_speeds, expected_members(config, case)) for case in coating_cases(config)}
