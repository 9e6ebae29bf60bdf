"""Tables of an identification: sets, what the waves leave, targets, exclusive claims, candidates."""

import itertools
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.extras.variations import emulator as emulation
from bladerub.extras.variations import waves
from bladerub.extras.variations.emulator import HeldOut, Predicted
from bladerub.extras.variations.job import read as read_jobs
from bladerub.extras.variations.plan import Plan
from bladerub.extras.variations.targets import TARGETS
from bladerub.study.findings.claim import YES, claim_of

PREDICTED = ("C6", "C9", "C12")
"""Claims without a target."""

_RANGES = ["factor", "unit", "lowest", "highest", "left_low", "left_median", "left_high"]
_RARE = 0.05  # a claim that holds in fewer sets says nothing about which others it goes with
_SELDOM = 0.5  # of the sets that chance would give: fewer are called an exclusion


def measured(paths: Iterable[str | Path]) -> pd.DataFrame:
    """Read the targets of all jobs: a row for each set, a column for each target, in their order."""
    table = read_jobs(paths, ["set", "target", "value"]).pivot(index="set", columns="target", values="value")
    return table[[name for name in TARGETS if name in table]]


def sets(plan: Plan, positions: pd.DataFrame, measured: pd.DataFrame) -> pd.DataFrame:
    """List every simulated set: a row for each factor, with its position and value, and the set's misfit."""
    table = waves.with_values(plan, positions)
    return table.assign(misfit=table.set.map(waves.misfit(measured)))


def left(plan: Plan, wave: int, measured: pd.DataFrame, positions: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """Find what the waves up to one leave of the ranges, and draw the sets of the next; tables by name."""
    simulated = positions.loc[measured.index].to_numpy()
    emulators = emulation.emulators(simulated, measured)
    remainder = waves.remaining(plan, emulators)
    drawn, first = waves.draw(plan, wave, remainder, emulators, simulated), plan.first(wave + 1)
    summary = (wave, len(measured), remainder.given_up, remainder.share)
    emulated = [
        (wave, name, *emulation.held_out(emulator), remainder.plausible[name])
        for name, emulator in emulators.items()
    ]
    predicted = [
        (number, name, mean, deviation)
        for name, emulator in emulators.items()
        for number, (mean, deviation) in enumerate(zip(*emulator.predict(drawn), strict=True), first)
    ]
    ranges = []
    for (name, factor), points in zip(plan.factors.items(), remainder.points.T, strict=True):
        ends = (0.0, 1.0, *np.quantile(points, [0.05, 0.5, 0.95]))
        ranges.append((name, factor.unit, *(factor.first_value(float(end)) for end in ends)))
    return {
        "left": pd.DataFrame([summary], columns=["wave", "sets", "given_up", "remaining"]),
        "emulators": pd.DataFrame(emulated, columns=["wave", "target", *HeldOut._fields, "plausible"]),
        "ranges": pd.DataFrame(ranges, columns=_RANGES),
        "next_sets": waves.as_table(plan, first, drawn),
        "predictions": pd.DataFrame(predicted, columns=["set", "target", "predicted_value", "deviation"]),
    }


def targets(measured: pd.DataFrame, predictions: pd.DataFrame) -> pd.DataFrame:
    """Compare targets with the paper; `measured` begins with the study, `predictions` are of later sets."""
    rows, implausible = [], waves.implausibility(measured)
    for name, values in measured.items():
        target, of_target = TARGETS[name], predictions[predictions.target == name].set_index("set")
        later = of_target.join(values.rename("simulated"), how="inner").dropna()
        predicted = Predicted(later.predicted_value.to_numpy(), later.deviation.to_numpy())
        about = {"target": name, "id": target.claim, "relation": target.relation, "paper_value": target.value}
        about |= {"error": target.error, "own_value": values.iloc[0]}
        about |= {"lowest": values.min(), "highest": values.max()}
        about["plausible"] = float((implausible[name] <= waves.CUTOFF).mean())
        rows.append(about | emulation.compared(later.simulated.to_numpy(), predicted)._asdict())
    return pd.DataFrame(rows)


def exclusions(verdicts: pd.DataFrame) -> pd.DataFrame:
    """List the pairs of claims that hold together in fewer than half as many sets as by chance."""
    holds = verdicts.assign(holds=verdicts.holds == YES).pivot(index="set", columns="id", values="holds")
    rows = []
    for one, other in itertools.combinations(holds.columns, 2):
        pair = holds[[one, other]].dropna().astype(bool)
        shares = pair.mean()
        both, chance = float(pair.all(axis=1).mean()), float(shares.prod())
        if shares.min() >= _RARE and both < _SELDOM * chance:
            rows.append((one, other, shares[one], shares[other], both, chance))
    columns = ["id", "other_id", "share", "other_share", "both", "by_chance"]
    return pd.DataFrame(rows, columns=columns).sort_values("both", ignore_index=True)


def of_candidates(plan: Plan, judged: pd.DataFrame) -> pd.DataFrame:
    """Return the verdicts of the finer studies, whose ``set`` is the number of the pair."""
    pairs = np.array(plan.candidates.pairs)[judged.set]
    table = judged.assign(candidate=pairs[:, 0], neighbour=pairs[:, 1])
    return table[[*waves.CANDIDATE, "id", "holds", "margin"]]


def counts(candidates: pd.DataFrame, verdicts: pd.DataFrame) -> pd.DataFrame:
    """Count the parts that hold for each candidate and neighbour, of the matched claims and of the others."""
    matched, yes = {target.claim for target in TARGETS.values()}, verdicts.holds == YES
    counted = verdicts[waves.CANDIDATE].assign(
        matched_yes=yes & verdicts.id.isin(matched),
        predicted_yes=yes & verdicts.id.map(claim_of).isin(PREDICTED),
        yes=yes,
        parts=True,
    )
    summed = counted.groupby(waves.CANDIDATE).sum().astype(int).reset_index()
    return candidates[waves.CANDIDATES].drop_duplicates().merge(summed, on=waves.CANDIDATE)
