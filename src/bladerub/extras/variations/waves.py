"""The sampler: positions of sets in the ranges of the factors, and how implausible the sets there are.

Those of a robustness, and of the first wave of an identification, are spread over all ranges (a scrambled
Sobol sequence), those of later waves over what is left.

The implausibility of a set is how far its targets miss what the paper prints, in standard deviations. For one
target that is the excess over the square root of the variances of reading, of another blade and of
the prediction (Craig, Goldstein, Seheult, Smith 1997; Vernon, Goldstein, Bower 2010, Bayesian Analysis 5).
A set is left as long as the implausibility of no target exceeds `CUTOFF`, save of so many as are given up.
In the end come the candidates, the best sets of all waves, and neighbours of them.
"""

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
import pandas as pd
from scipy.spatial.distance import cdist
from scipy.stats import qmc

from bladerub.extras.variations.plan import Plan
from bladerub.extras.variations.targets import TARGETS
from bladerub.io.tables import read as read_table
from bladerub.settings.study import Config
from bladerub.study.findings.claim import YES

if TYPE_CHECKING:
    from bladerub.extras.variations.emulator import Emulator

POSITIONS = ["set", "factor", "range_fraction"]
"""Columns of the sets of a wave: each factor as a fraction of its range."""

CUTOFF = 3.0
"""Implausibility above which a set is ruled out: at most 5 % of any unimodal distribution lies beyond."""

POINTS = 2**14
"""Points at which it is asked what is left of the ranges; a power of two."""

OWN = 0
"""Number of the set that has the study's own values."""

CANDIDATE = ["candidate", "neighbour"]
CANDIDATES = [*CANDIDATE, "set", "misfit"]
"""Columns that tell the rows of `choose` apart."""

DRAWN = 256
"""Least number of points drawn from what is left: the next sets are the first of them."""

_ENOUGH = 10  # points left for each to draw, or more are looked for near those there are
_REACH = 0.1  # how far, in ranges
_ROUNDS = 5
_GREATEST = 3.0  # implausibility from which a target is lost: one that is lost is not worth five


class Remaining(NamedTuple):
    """What is left of the ranges."""

    points: np.ndarray  # (m, d), plausible ones of `POINTS` spread evenly
    share: float  # of the volume
    given_up: int  # targets that had to be, so that enough was left
    plausible: pd.Series  # share of the volume that each target alone leaves


def design(plan: Plan) -> np.ndarray:
    """Return the positions (n, d) of all samples of a robustness."""
    return _spread(plan, np.random.default_rng(plan.seed), plan.waves[0])


def known(plan: Plan) -> dict[int, np.ndarray]:
    """Return the position (d,) of each sample of a robustness; those of an identification are in tables."""
    return dict(enumerate(design(plan))) if plan.factors and not plan.candidates else {}


def first(plan: Plan, study: Config) -> np.ndarray:
    """Return the positions (n, d) of the first wave: the study's own, the given ones, a Sobol sequence."""
    return np.vstack([plan.listed(study), design(plan)])


def as_table(plan: Plan, number: int, drawn: np.ndarray) -> pd.DataFrame:
    """Make the table of the sets `drawn` (n, d), numbered from `number`, with `POSITIONS`."""
    numbers = pd.RangeIndex(number, number + len(drawn), name="set")
    return _as_long(pd.DataFrame(drawn, numbers, list(plan.factors)))


def with_values(plan: Plan, sets: pd.DataFrame) -> pd.DataFrame:
    """Make a row for each factor of each set, with the first number that the factor sets, and its unit."""
    table = _as_long(sets)
    positions = zip(table.factor, table.range_fraction, strict=True)
    values = [plan.factors[name].first_value(position) for name, position in positions]
    return table.assign(value=values, unit=[plan.factors[name].unit for name in table.factor])


def _as_long(positions: pd.DataFrame) -> pd.DataFrame:
    return positions.rename_axis(columns="factor").stack().rename("range_fraction").reset_index()


def read(paths: Iterable[str | Path], index: str | list[str] = "set") -> pd.DataFrame:
    """Read positions: a row for each set, or for each `CANDIDATE`, a column for each factor in order."""
    long = pd.concat([read_table(path, POSITIONS) for path in paths])
    wide = long.pivot(index=index, columns="factor", values="range_fraction")
    return wide[list(dict.fromkeys(long.factor))]


def implausibility(measured: pd.DataFrame) -> pd.DataFrame:
    """Return that of simulated sets (rows) for each of their `measured` targets; NaN as there."""
    return measured.apply(lambda values: TARGETS[values.name].excess(values) / TARGETS[values.name].error)


def predicted_implausibility(emulated: Mapping[str, "Emulator"], positions: np.ndarray) -> pd.DataFrame:
    """Predict that of each emulated target (columns) at `positions` (m, d)."""
    table = pd.DataFrame(index=range(len(positions)))  # also where nothing is emulated
    for name, emulator in emulated.items():
        (mean, deviation), target = emulator.predict(positions), TARGETS[name]
        table[name] = target.excess(mean) / np.hypot(target.error, deviation)
    return table


def worst(implausible: pd.DataFrame, given_up: int) -> np.ndarray:
    """Return the greatest implausibility of each set (n,), that of so many worse targets left out."""
    values = np.sort(np.nan_to_num(implausible.to_numpy(), nan=np.inf), axis=1)
    return values[:, -1 - given_up] if given_up < values.shape[1] else np.zeros(len(values))


def remaining(plan: Plan, emulated: Mapping[str, "Emulator"]) -> Remaining:
    """Find what is left of the ranges; as few targets are given up as leave the share of the plan."""
    points = _spread(plan, np.random.default_rng([plan.seed, 0]), POINTS)
    implausible = predicted_implausibility(emulated, points)
    for given_up in range(implausible.shape[1] + 1):
        plausible = worst(implausible, given_up) <= CUTOFF
        if plausible.mean() >= plan.remaining:
            break
    return Remaining(points[plausible], float(plausible.mean()), given_up, (implausible <= CUTOFF).mean())


def draw(
    plan: Plan, wave: int, remainder: Remaining, emulated: Mapping[str, "Emulator"], simulated: np.ndarray
) -> np.ndarray:
    """Draw plausible points (n, d), each as far as can be from those before it and from the `simulated`."""
    rng, count, points = np.random.default_rng([plan.seed, wave]), max(DRAWN, *plan.waves), remainder.points
    for _ in range(_ROUNDS):
        if len(points) >= _ENOUGH * count:
            break
        neighbours = points[rng.integers(len(points), size=POINTS // 4)]
        neighbours = np.clip(neighbours + rng.uniform(-_REACH, _REACH, neighbours.shape), 0.0, 1.0)
        plausible = worst(predicted_implausibility(emulated, neighbours), remainder.given_up) <= CUTOFF
        points = np.vstack([points, neighbours[plausible]])
    distance, indices = cdist(points, simulated).min(axis=1), []
    for _ in range(min(count, len(points))):
        indices.append(int(distance.argmax()))
        distance = np.minimum(distance, cdist(points, points[indices[-1:]])[:, 0])
    return points[indices]


def misfit(measured: pd.DataFrame) -> pd.Series:
    """Return the misfit of each simulated set: mean square of the implausibility of its targets, bounded."""
    bounded = implausibility(measured).fillna(_GREATEST).clip(upper=_GREATEST)
    return (bounded**2).mean(axis=1)


def choose(plan: Plan, sets: pd.DataFrame, measured: pd.DataFrame, verdicts: pd.DataFrame) -> pd.DataFrame:
    """Choose the study's own set and those in which most parts hold, by misfit among equals; draw neighbours.

    `sets` has the position of each factor, `measured` the targets, and `verdicts` a row for each part.
    """
    misfits = misfit(measured)
    yes = (verdicts.holds == YES).groupby(verdicts["set"]).sum()
    ranked = pd.DataFrame({"yes": -yes, "misfit": misfits}).drop(OWN).sort_values(["yes", "misfit"])
    best = [OWN, *ranked.index[: plan.candidates.number]]
    rng, rows = np.random.default_rng([plan.seed, len(plan.waves) + 1]), []
    for candidate, neighbour in plan.candidates.pairs:
        number = best[candidate]
        signs = rng.choice([-1.0, 1.0], len(plan.factors)) if neighbour else np.zeros(len(plan.factors))
        position = np.clip(sets.loc[number] + plan.candidates.shift * signs, 0.0, 1.0)
        rows.append((candidate, neighbour, number, misfits[number], *position))
    return pd.DataFrame(rows, columns=[*CANDIDATES, *plan.factors]).set_index(CANDIDATES)


def _spread(plan: Plan, rng: np.random.Generator, count: int) -> np.ndarray:
    sequence = qmc.Sobol(len(plan.factors), scramble=True, rng=rng)
    return sequence.random_base2(int(np.ceil(np.log2(count))))[:count]
