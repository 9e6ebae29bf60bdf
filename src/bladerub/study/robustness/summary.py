"""Tables of the design: in which share of it a claim holds, what decides that, and what a sample costs."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd
from scipy import stats

from bladerub.study.findings import TITLES, claim_of
from bladerub.study.findings.finding import NO, PARTLY, YES
from bladerub.study.robustness import sample
from bladerub.study.robustness.plan import Plan
from bladerub.study.robustness.sensitivity import indices
from bladerub.tablefile import read as read_table

SCORE = {YES: 1.0, PARTLY: 0.5, NO: 0.0}
"""A verdict as a number, for what decides it."""

DECIDES = 0.1
"""Total index from which on a factor is named among those that decide."""

TRUSTED = 0.1
"""Share of the variance that must be predicted before any factor is named."""

VERDICT, MARGIN = "verdict", "margin"
"""Outputs whose indices are estimated: `SCORE`, and the rank of the margin, which may be infinite."""


def design(plan: Plan) -> pd.DataFrame:
    """List the value of each factor in each sample."""
    return pd.DataFrame(
        [
            {"sample": number, "factor": factor.name, "value": factor.value(float(at)), "unit": factor.unit}
            for number, places in enumerate(plan.places())
            for factor, at in zip(plan.factors, places, strict=True)
        ]
    )


def gather(paths: Iterable[str | Path]) -> pd.DataFrame:
    """Put what the samples say into one table, ordered by claim and sample."""
    whole = pd.concat([read_table(path, sample.COLUMNS) for path in paths], ignore_index=True)
    whole["id"] = pd.Categorical(whole["id"], list(TITLES), ordered=True)
    return whole.sort_values(["id", "sample"], ignore_index=True).astype({"id": str})


def sensitivities(plan: Plan, verdicts: pd.DataFrame) -> pd.DataFrame:
    """Estimate what decides each claim, and what moves its margin.

    Parameters
    ----------
    plan : Plan
        The design.
    verdicts : DataFrame
        From `gather`.

    Returns
    -------
    DataFrame
        A row per claim, output (`VERDICT`, `MARGIN`) and factor; none where there are no indices.
    """
    places, rows = plan.places(), []
    for id_, said in verdicts.groupby("id", sort=False):
        ranked = said[said.margin.notna()]
        outputs = {
            VERDICT: (said["sample"], said.holds.map(SCORE).to_numpy()),
            MARGIN: (ranked["sample"], stats.rankdata(ranked.margin)),
        }
        for output, (samples, values) in outputs.items():
            found = indices(places[samples.to_numpy()], values)
            if np.isnan(found.predicted):
                continue
            rows += [
                {
                    "id": id_,
                    "output": output,
                    "factor": factor.name,
                    "first": found.first[number],
                    "total": found.total[number],
                    "predicted": found.predicted,
                }
                for number, factor in enumerate(plan.factors)
            ]
    return pd.DataFrame(rows, columns=["id", "output", "factor", "first", "total", "predicted"])


def summary(
    plan: Plan, verdicts: pd.DataFrame, sensitivity: pd.DataFrame, cost: pd.DataFrame
) -> pd.DataFrame:
    """Tell of each claim in which share of the design it holds, what decides that, and what it costs to know.

    Parameters
    ----------
    plan : Plan
    verdicts, sensitivity : DataFrame
        From `gather` and `sensitivities`.
    cost : DataFrame
        A row per part and sample, with `bladerub.study.robustness.sample.COST`.

    Returns
    -------
    DataFrame
        A row per claim.
    """
    part_of = {claim: part.name for part in plan.parts.values() for claim in part.claims}
    of_part, rows = cost.groupby("part")[["runs", "cpu_s"]].median(), []
    for id_, said in verdicts.groupby("id", sort=False):
        part = part_of[claim_of(id_)]
        shares = said.holds.value_counts(normalize=True)
        own = sensitivity[(sensitivity.id == id_) & (sensitivity.output == VERDICT)]
        predicted = own.predicted.iloc[0] if len(own) else np.nan
        deciding = own[own.total >= DECIDES].sort_values("total", ascending=False)
        named = (f"{row.factor} {row.total:.2f}" for row in deciding.itertuples())
        rows.append(
            {
                "id": id_,
                "claim": TITLES[id_],
                "part": part,
                "samples": len(said),
                **{f"{word}_share": shares.get(word, 0.0) for word in (YES, PARTLY, NO)},
                "predicted": predicted,
                "decided_by": ", ".join(named) if predicted >= TRUSTED else "",
                "runs": of_part.runs[part],
                "cpu_s": of_part.cpu_s[part],
            }
        )
    return pd.DataFrame(rows)
