"""What the jobs of a study cost, and how the cores of a machine are divided among them."""

import math
from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from bladerub import plugins
from bladerub.settings.study import Config
from bladerub.study.grid import coating_cases, speeds

FEWEST = 8
"""Jobs that a core should have to do, at least: the last ones then end at nearly the same time."""

ON_RIGID_CASING = 7
"""Time of a run on the rigid casing over that of one on a soft coating, about."""

STIFF, EXPONENT = 12.0, 0.6
"""E / f_omega from which on the time of a run grows, as its steps do, and the power by which it does."""

SECONDS_PER_REVOLUTION = 0.0014
"""Of one core, for a run of the paper's blade on a soft coating, with the other core at work: the jobs of
the 42 softest coatings of the study (docs/data/cost.csv), and a tenth more."""

GROWING = 0.09
"""Share of the runs that grow, and go on to the longer length (the study's 63 coatings)."""

SECONDS_PER_JOB = 3
"""Of one core, to start Snakemake and the job and to draw, collect or analyse; rounded up."""

SECONDS_AT_FIRST = {"blade": 10, "compile_kernel": 10}
"""Of one core, for the jobs that are made once, by their rule."""


class Costs(NamedTuple):
    """What the jobs of each coating of a study cost, by its name, in runs on a soft coating."""

    runs: Mapping[str, float]
    further: Mapping[str, Mapping[str, float]]  # by the name of the rule first (``COSTS`` of `plugins`)

    @property
    def total(self) -> float:
        """Of the whole study."""
        return sum(self.runs.values()) + sum(sum(costs.values()) for costs in self.further.values())

    def threads(self, rule: str, coating: str, cores: int | None) -> int:
        """Return the threads of the job of a rule and a coating, which may be one that is run on request."""
        cost = self.further.get(rule, self.runs).get(coating, min(self.runs.values()))
        return threads_for(cost, self.total, cores)

    def priority(self, coating: str) -> float:
        """Priority, below 1, of the runs of a `coating`: those that take longest come first."""
        of_coating = sum(part.get(coating, 0) for part in (self.runs, *self.further.values()))
        return of_coating / (1 + self.total)


def threads_for(cost: float, total: float, cores: int | None) -> int:
    """Return the threads of a job: one, unless it is so large that it would end long after all others."""
    if not cores:
        return 1
    return max(1, min(cores, math.ceil(FEWEST * cost / total * cores - 1)))


def run_cost(E: float, f_omega: np.ndarray) -> np.ndarray:
    """Estimate what runs at the speeds `f_omega` (n,) cost on a coating of modulus `E`, in soft ones (n,)."""
    return np.maximum(1.0, E / STIFF / f_omega) ** EXPONENT


def costs_of(config: Config) -> Costs:
    """Estimate what the jobs of a study cost."""
    f_omega = np.array(speeds(config))
    weights = {
        case: ON_RIGID_CASING if case.is_rigid else float(run_cost(case.E, f_omega).mean())
        for case in coating_cases(config)
    }
    return Costs(
        runs={case.name: weight * f_omega.size for case, weight in weights.items()},
        further={
            rule: {case.name: weight * cost(config, case) for case, weight in weights.items()}
            for rule, cost in plugins.loaded("COSTS").items()
        },
    )
