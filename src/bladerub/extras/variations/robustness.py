"""Tables of the design: the share in which a claim holds, what decides that, and the cost of a sample."""

from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd

from bladerub.extras.variations import job, waves
from bladerub.extras.variations.plan import REFERENCE, Plan
from bladerub.extras.variations.sensitivity import Indices, indices
from bladerub.study.findings import CLAIMS
from bladerub.study.findings.claim import NO, SCORE, claim_of

_TITLES = {claim.id: claim.statement for claim in CLAIMS}

DECIDES = 0.1
"""Total index from which a factor is named among those that decide."""

VERDICT, MARGIN = "verdict", "margin"
"""Outputs whose indices are estimated: `SCORE`, and the rank of the margin, which may be infinite."""


def design(plan: Plan) -> pd.DataFrame:
    """List what each factor sets in each sample: a row for each number of the config."""
    return pd.DataFrame(
        [
            {"sample": number, "factor": name, "key": key, "value": value, "unit": factor.unit}
            for number, row in enumerate(waves.design(plan))
            for (name, factor), position in zip(plan.factors.items(), row, strict=True)
            for key, value in factor.values(float(position)).items()
        ]
    )


def collect(paths: Iterable[str | Path]) -> pd.DataFrame:
    """Put the verdicts of all jobs into one table, ordered by claim and sample, the reference first."""
    table = job.read(paths).rename(columns={"set": "sample"})[["sample", "id", "holds", "margin"]]
    table["id"] = pd.Categorical(table["id"], list(_TITLES), ordered=True)
    return table.sort_values(["id", "sample"], ignore_index=True).astype({"id": str})


def sensitivities(plan: Plan, verdicts: pd.DataFrame) -> pd.DataFrame:
    """Estimate what decides each claim, and what changes its margin, from `verdicts` of `collect`.

    A row per claim, output (`VERDICT`, `MARGIN`) and factor; none where there are no indices.
    """
    positions, rows = waves.design(plan), []
    for id_, of_claim in verdicts[verdicts["sample"] != REFERENCE].groupby("id", sort=False):
        # a claim that fails because nothing is found has no margin: it fails by more than any other
        margin = of_claim.margin.where(of_claim.margin.notna() | (of_claim.holds != NO), -np.inf)
        outputs = {VERDICT: of_claim.holds.map(SCORE), MARGIN: margin[margin.notna()].rank()}
        for output, values in outputs.items():
            estimate = indices(positions[of_claim.loc[values.index, "sample"]], values.to_numpy())
            if np.isnan(estimate.predicted):
                continue
            rows += [
                (id_, output, factor, first, total, estimate.predicted)
                for factor, first, total in zip(plan.factors, estimate.first, estimate.total, strict=True)
            ]
    return pd.DataFrame(rows, columns=["id", "output", "factor", *Indices._fields])


def summary(
    plan: Plan, verdicts: pd.DataFrame, sensitivity: pd.DataFrame, cost: pd.DataFrame
) -> pd.DataFrame:
    """Sum up each claim: the share of the design in which it holds, what decides that, and the cost.

    `verdicts` is from `collect`, `sensitivity` from `sensitivities`, `cost` from the jobs. A row for each
    part of each claim of the plan; shares are of the samples that have a verdict.
    """
    part_of = {claim: part.name for part in plan.parts.values() for claim in part.claims}
    own_values, drawn = (verdicts["sample"] == REFERENCE), cost[cost["set"] != REFERENCE]
    reference = verdicts[own_values].set_index("id").holds
    of_part = drawn.groupby("part")[["runs", "cpu_s"]].median()
    shares = pd.crosstab(verdicts.id[~own_values], verdicts.holds[~own_values])
    shares = shares.reindex(index=_TITLES, columns=SCORE, fill_value=0)
    rows = []
    for id_, counts in shares.iterrows():
        if claim_of(id_) not in part_of:
            continue
        part, n_samples = part_of[claim_of(id_)], counts.sum()
        verdict_indices = sensitivity[(sensitivity.id == id_) & (sensitivity.output == VERDICT)]
        deciding = verdict_indices[verdict_indices.total >= DECIDES].sort_values("total", ascending=False)
        rows.append(
            {
                "id": id_,
                "claim": _TITLES[id_],
                "part": part,
                "samples": n_samples,
                **{f"{word}_share": counts[word] / n_samples if n_samples else np.nan for word in SCORE},
                "reference": reference.get(id_, ""),
                "predicted": verdict_indices.predicted.iloc[0] if len(verdict_indices) else np.nan,
                "decided_by": ", ".join(f"{row.factor} {row.total:.2f}" for row in deciding.itertuples()),
                "runs_per_sample": of_part.runs[part],
                "cpu_s_per_sample": of_part.cpu_s[part],
            }
        )
    return pd.DataFrame(rows)
