"""Tables of the design: the share in which a claim holds, what decides that, and the cost of a sample.

What decides are first-order and total Sobol indices of each factor, from a sparse polynomial chaos expansion.
The samples are those of one design, so that the indices take no further run; the expansion is OpenTURNS's
(Sudret 2008, Reliability Engineering & System Safety 93; Blatman and Sudret 2011, Journal of Computational
Physics 230). An expansion explains a part of the output only: the share of the variance that expansions made
without a fifth of the samples predict for that fifth. The indices are shares of what is explained; multiplied
by that share they become shares of the whole variance.
"""

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pandas as pd

from bladerub.extras.variations import job, waves
from bladerub.extras.variations.emulator import Predicted, compared, from_others
from bladerub.extras.variations.plan import REFERENCE, Plan
from bladerub.extras.variations.settings import FEWEST
from bladerub.io.errors import package
from bladerub.study.findings import CLAIMS
from bladerub.study.findings.claim import NO, SCORE, claim_of

openturns = package("openturns", "uq")

_TITLES = {claim.id: claim.statement for claim in CLAIMS}

DECIDES = 0.1
"""Total index from which a factor is named among those that decide."""

VERDICT, MARGIN = "verdict", "margin"
"""Outputs whose indices are estimated: `SCORE`, and the rank of the margin, which may be infinite."""

DEGREE = 4
"""Highest degree of a polynomial in one factor."""

SPARSITY = 0.5
"""Norm of the degrees in several factors that `DEGREE` bounds: the lower, the fewer interactions."""


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
    """Estimate `indices` from the `verdicts` of `collect`: a row per claim, output and factor."""
    positions, rows = waves.design(plan), []
    for id_, of_claim in verdicts[verdicts["sample"] != REFERENCE].groupby("id", sort=False):
        # a claim that fails because nothing is found has no margin: it fails by more than any other
        margin = of_claim.margin.where(of_claim.margin.notna() | (of_claim.holds != NO), -np.inf)
        outputs = {VERDICT: of_claim.holds.map(SCORE), MARGIN: margin[margin.notna()].rank()}
        for output, values in outputs.items():
            estimate = indices(positions[of_claim.loc[values.index, "sample"]], values.to_numpy())
            if not np.isnan(estimate.predicted):
                shares = zip(plan.factors, estimate.first, estimate.total, strict=True)
                rows += [(id_, output, *of_factor, estimate.predicted) for of_factor in shares]
    return pd.DataFrame(rows, columns=["id", "output", "factor", *Indices._fields])


def summary(
    plan: Plan, verdicts: pd.DataFrame, sensitivity: pd.DataFrame, cost: pd.DataFrame
) -> pd.DataFrame:
    """Sum up each part of each claim by `collect` and `sensitivities`; shares are of what has a verdict."""
    part_of = {claim: part.name for part in plan.parts.values() for claim in part.claims}
    parts = pd.Series({id_: part_of[claim_of(id_)] for id_ in _TITLES if claim_of(id_) in part_of})
    own_values, drawn = (verdicts["sample"] == REFERENCE), cost[cost["set"] != REFERENCE]
    of_part = drawn.groupby("part")[["runs", "cpu_s"]].median()
    counts = pd.crosstab(verdicts.id[~own_values], verdicts.holds[~own_values])
    counts = counts.reindex(index=parts.index, columns=SCORE, fill_value=0)
    of_verdict = sensitivity[sensitivity.output == VERDICT]
    deciding = of_verdict[of_verdict.total >= DECIDES].sort_values("total", ascending=False)
    deciding = deciding.factor.str.cat(deciding.total.map("{:.2f}".format), " ").groupby(deciding.id)
    table = pd.DataFrame({"claim": _TITLES, "part": parts, "samples": counts.sum(axis=1)}).loc[parts.index]
    table = table.join(counts.div(table.samples, axis=0).add_suffix("_share"))
    table["reference"] = verdicts[own_values].set_index("id").holds
    table["predicted"] = of_verdict.groupby("id").predicted.first()
    table["decided_by"] = deciding.agg(", ".join)
    table["runs_per_sample"], table["cpu_s_per_sample"] = parts.map(of_part.runs), parts.map(of_part.cpu_s)
    return table.fillna({"reference": "", "decided_by": ""}).rename_axis("id").reset_index()


class Indices(NamedTuple):
    """Sobol indices of one output for d factors: shares of its variance, as far as it is predicted."""

    first: np.ndarray  # (d,), by each factor alone
    total: np.ndarray  # (d,), by each factor with all its interactions
    predicted: float  # share predicted for samples left out; 0 if that is worse than their mean


def indices(positions: np.ndarray, output: np.ndarray) -> Indices:
    """Estimate the indices of `output` (n,) at `positions` (n, d), from 0 to 1; NaN of too few samples."""
    factors = range(positions.shape[1])
    if output.size < FEWEST or np.ptp(output) == 0:
        return Indices(*np.full((2, len(factors)), np.nan), np.nan)
    sobol = openturns.FunctionalChaosSobolIndices(_expansion(positions, output))
    predicted = max(compared(output, from_others(positions, output, _fit)).explained, 0.0)
    first = predicted * np.array([sobol.getSobolIndex(factor) for factor in factors])
    total = predicted * np.array([sobol.getSobolTotalIndex(factor) for factor in factors])
    return Indices(first, total, predicted)


def _fit(positions: np.ndarray, output: np.ndarray) -> Callable[[np.ndarray], Predicted]:
    if np.ptp(output) == 0:
        return lambda others: Predicted(output[0], 0.0)
    model = _expansion(positions, output).getMetaModel()
    return lambda others: Predicted(np.array(model(others)).ravel(), 0.0)


def _expansion(positions: np.ndarray, output: np.ndarray) -> openturns.FunctionalChaosResult:
    n_factors, uniform = positions.shape[1], openturns.Uniform(0.0, 1.0)
    counting = openturns.HyperbolicAnisotropicEnumerateFunction(n_factors, SPARSITY)
    polynomials = [openturns.StandardDistributionPolynomialFactory(uniform)] * n_factors
    basis = openturns.OrthogonalProductPolynomialFactory(polynomials, counting)
    selection = openturns.LeastSquaresMetaModelSelectionFactory(
        openturns.LARS(), openturns.CorrectedLeaveOneOut()
    )
    expansion = openturns.FunctionalChaosAlgorithm(
        openturns.Sample(positions),
        openturns.Sample(output[:, None].astype(float)),
        openturns.JointDistribution([uniform] * n_factors),
        openturns.FixedStrategy(basis, counting.getMaximumDegreeCardinal(DEGREE)),
        openturns.LeastSquaresStrategy(selection),
    )
    expansion.run()
    return expansion.getResult()
