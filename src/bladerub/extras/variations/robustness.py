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
    verdicts = job.read(paths, job.VERDICTS).rename(columns={"set": "sample"})
    table = verdicts[["sample", "id", "holds", "margin"]].copy()
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
    ids = [id_ for id_ in _TITLES if claim_of(id_) in part_of]
    parts = pd.Series({id_: part_of[claim_of(id_)] for id_ in ids})
    own_values, drawn = (verdicts["sample"] == REFERENCE), cost[cost["set"] != REFERENCE]
    of_part = drawn.groupby("part")[["runs", "cpu_s"]].median()
    counts = pd.crosstab(verdicts.id[~own_values], verdicts.holds[~own_values])
    counts = counts.reindex(index=ids, columns=SCORE, fill_value=0)
    of_verdict = sensitivity[sensitivity.output == VERDICT]
    deciding = of_verdict[of_verdict.total >= DECIDES].sort_values("total", ascending=False)
    deciding = deciding.factor.str.cat(deciding.total.map("{:.2f}".format), " ").groupby(deciding.id)
    table = pd.DataFrame({"claim": _TITLES, "part": parts, "samples": counts.sum(axis=1)}).loc[ids]
    table = table.join(counts.div(table.samples, axis=0).add_suffix("_share"))
    table["reference"] = verdicts[own_values].set_index("id").holds
    table["predicted"] = of_verdict.groupby("id").predicted.first()
    table["decided_by"] = deciding.agg(", ".join)
    table["runs_per_sample"], table["cpu_s_per_sample"] = parts.map(of_part.runs), parts.map(of_part.cpu_s)
    return table.fillna({"reference": "", "decided_by": ""}).rename_axis("id").reset_index()
