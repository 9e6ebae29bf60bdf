"""The sets of a wave: those of the first are spread over all ranges, those of others over what is left."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.spatial.distance import cdist
from scipy.stats import qmc

from bladerub.extras.identification.implausibility import CUTOFF, predicted, without
from bladerub.extras.identification.plan import Plan

if TYPE_CHECKING:
    from bladerub.extras.identification.emulator import Emulator

POINTS = 2**14
"""Points at which it is asked what is left of the ranges; a power of two."""

DRAWN = 256
"""Least number of points drawn from what is left: the next sets are the first of them."""

_ENOUGH = 10  # points left for each to draw, or more are looked for near those there are
_REACH = 0.1  # how far, in ranges
_ROUNDS = 5


class Remaining(NamedTuple):
    """What is left of the ranges."""

    points: np.ndarray  # (m, d), plausible ones of `POINTS` spread evenly
    share: float  # of the volume
    given_up: int  # targets that had to be, so that enough was left
    plausible: pd.Series  # share of the volume that each target alone leaves


def first(plan: Plan, study: Mapping[str, Any]) -> np.ndarray:
    """Return the positions (n, d) of the first wave: the study's own, the given ones, a Sobol sequence."""
    drawn = _spread(plan, np.random.default_rng(plan.seed), plan.waves[0])
    return np.vstack([plan.given(study), drawn])


def remaining(plan: Plan, emulated: Mapping[str, "Emulator"]) -> Remaining:
    """Find what is left of the ranges; as few targets are given up as leave the share of the plan."""
    points = _spread(plan, np.random.default_rng([plan.seed, 0]), POINTS)
    implausible = predicted(emulated, points)
    for given_up in range(implausible.shape[1] + 1):
        plausible = without(implausible, given_up) <= CUTOFF
        if plausible.mean() >= plan.remaining:
            break
    return Remaining(points[plausible], float(plausible.mean()), given_up, (implausible <= CUTOFF).mean())


def draw(
    plan: Plan, wave: int, remainder: Remaining, emulated: Mapping[str, "Emulator"], simulated: np.ndarray
) -> np.ndarray:
    """Draw plausible points (n, d) for the wave after `wave`, far from each other and from the `simulated`.

    Each is as far as possible from those before it. There are `DRAWN`, or as many as the wave needs.
    """
    rng = np.random.default_rng([plan.seed, wave])
    count = max(DRAWN, *plan.waves)
    points = remainder.points
    for _ in range(_ROUNDS):
        if len(points) >= _ENOUGH * count:
            break
        neighbours = points[rng.integers(len(points), size=POINTS // 4)]
        neighbours = np.clip(neighbours + rng.uniform(-_REACH, _REACH, neighbours.shape), 0.0, 1.0)
        plausible = without(predicted(emulated, neighbours), remainder.given_up) <= CUTOFF
        points = np.vstack([points, neighbours[plausible]])
    distance, indices = cdist(points, simulated).min(axis=1), []
    for _ in range(min(count, len(points))):
        indices.append(int(distance.argmax()))
        distance = np.minimum(distance, cdist(points, points[indices[-1:]])[:, 0])
    return points[indices]


def _spread(plan: Plan, rng: np.random.Generator, count: int) -> np.ndarray:
    sequence = qmc.Sobol(len(plan.factors), scramble=True, rng=rng)
    return sequence.random_base2(int(np.ceil(np.log2(count))))[:count]
