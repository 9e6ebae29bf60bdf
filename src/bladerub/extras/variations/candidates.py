"""The best sets of all waves and their neighbours, judged by all claims on a finer grid."""

from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.extras.variations.plan import Plan
from bladerub.extras.variations.targets import TARGETS
from bladerub.extras.variations.waves import implausibility, with_values
from bladerub.extras.variations.waves import read as read_positions
from bladerub.study.findings.claim import YES, claim_of

_GREATEST = 3.0  # implausibility from which a target is lost: one that is lost is not worth five

OWN = 0
"""Number of the set that has the study's own values."""

PREDICTED = ("C6", "C9", "C12")
"""Claims without a target."""

_INDEX = ["candidate", "neighbour", "set", "misfit"]


def misfit(measured: pd.DataFrame) -> pd.Series:
    """Return the misfit of each simulated set: mean square of the implausibility of its targets, bounded."""
    bounded = implausibility(measured).fillna(_GREATEST).clip(upper=_GREATEST)
    return (bounded**2).mean(axis=1)


def choose(
    plan: Plan, positions: pd.DataFrame, measured: pd.DataFrame, verdicts: pd.DataFrame
) -> pd.DataFrame:
    """Choose the sets in which most parts hold, and draw neighbours; the misfit decides among equals.

    `positions` and `measured` have a row for each simulated set, `verdicts` one for each part as well. A row
    for each candidate (from 0, which has the study's own values) and neighbour (0: the set itself), with
    ``set``, ``misfit`` of the set, and the position of each factor.
    """
    misfits = misfit(measured)
    yes = (verdicts.holds == YES).groupby(verdicts["set"]).sum()
    ranked = pd.DataFrame({"yes": -yes, "misfit": misfits}).drop(OWN).sort_values(["yes", "misfit"])
    best = [OWN, *ranked.index[: plan.candidates.number]]
    rng, rows = np.random.default_rng([plan.seed, len(plan.waves) + 1]), []
    for candidate, neighbour in plan.candidates.pairs:
        number = best[candidate]
        signs = rng.choice([-1.0, 1.0], len(plan.factors)) if neighbour else np.zeros(len(plan.factors))
        position = np.clip(positions.loc[number] + plan.candidates.shift * signs, 0.0, 1.0)
        rows.append((candidate, neighbour, number, misfits[number], *position))
    return pd.DataFrame(rows, columns=[*_INDEX, *plan.factors])


def as_table(plan: Plan, candidates: pd.DataFrame) -> pd.DataFrame:
    """Make the long table of `choose`: a row for each factor, with its position and value."""
    return with_values(plan, candidates.set_index(_INDEX))


def read(path: str | Path) -> pd.DataFrame:
    """Read a table of `as_table`: the position of each factor (columns) by candidate and neighbour."""
    return read_positions([path], _INDEX[:2])


def verdicts(plan: Plan, judged: pd.DataFrame) -> pd.DataFrame:
    """Return the verdicts of the finer studies, whose ``set`` is the number of the pair."""
    pairs = np.array(plan.candidates.pairs)[judged.set]
    return judged.assign(candidate=pairs[:, 0], neighbour=pairs[:, 1])[[*_INDEX[:2], "id", "holds", "margin"]]


def counts(candidates: pd.DataFrame, verdicts: pd.DataFrame) -> pd.DataFrame:
    """Count the parts that hold for each candidate and neighbour, of the matched claims and of the others.

    `candidates` is from `as_table`, `verdicts` from the function of this name.
    """
    matched = {target.claim for target in TARGETS.values()}
    yes = verdicts.holds == YES
    counted = verdicts[_INDEX[:2]].assign(
        matched_yes=yes & verdicts.id.isin(matched),
        predicted_yes=yes & verdicts.id.map(claim_of).isin(PREDICTED),
        yes=yes,
        parts=True,
    )
    summed = counted.groupby(_INDEX[:2]).sum().astype(int).reset_index()
    return candidates[_INDEX].drop_duplicates().merge(summed, on=_INDEX[:2])
