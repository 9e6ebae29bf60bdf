"""The report on the errors of many runs: how they are distributed, and which runs are beyond tolerance."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from bladerub.verification.differences import Differences
from bladerub.verification.verify import TOLERANCE, Seconds, VerifiedRun


def report(verified: Sequence[VerifiedRun]) -> dict[str, Any]:
    """Sum up the errors of runs.

    Parameters
    ----------
    verified : sequence of VerifiedRun
        One run or more.

    Returns
    -------
    dict
        Plain values that JSON can hold; differences are fractions, None for infinite ones.

        - ``n``, and ``within_1_percent``: the fraction within `TOLERANCE` in wear and spectral peak;
        - ``wear_l2``, ``peak``, ``revolution_peak``, ``energy_residual``: each from `distribution`;
        - ``worst``: the name of the worst run in each of the first three;
        - ``against_paper_scheme``: the three for the differences from the paper's scheme, and under
          ``uncertainty`` the three for its own error;
        - ``speedup_at_equal_error``: the median over the runs that have one and are not sensitive, None if
          there are none, and ``left_out``: how many runs are not in that median;
        - ``seconds``: mean cost of a run of each kind;
        - ``beyond``: the runs beyond `TOLERANCE` in any of the three, the worst first.
    """
    errors = [run.error for run in verified]
    within = [max(error.wear_l2, error.peak) <= TOLERANCE for error in errors]
    speedups = [run.speedup for run in verified if run.speedup is not None and not run.sensitive]
    beyond = sorted((run for run in verified if run.is_beyond), key=lambda run: -max(run.error))
    return {
        "n": len(verified),
        "within_1_percent": float(np.mean(within)),
        **_distributions(errors),
        "energy_residual": distribution([run.energy_residual for run in verified]),
        "worst": {
            measure: max(verified, key=lambda run: getattr(run.error, measure)).run.name
            for measure in Differences._fields
        },
        "against_paper_scheme": _distributions([run.against_paper for run in verified])
        | {"uncertainty": _distributions([run.paper_uncertainty for run in verified])},
        "speedup_at_equal_error": float(np.median(speedups)) if speedups else None,
        "left_out": len(verified) - len(speedups),
        "seconds": dict(
            zip(Seconds._fields, np.mean([run.seconds for run in verified], axis=0).tolist(), strict=True)
        ),
        "beyond": [_entry(run) for run in beyond],
    }


def distribution(values: Sequence[float]) -> dict[str, float | None]:
    """Median, 95th centile and maximum.

    The 95th centile is the smallest value that at least 95 % of the values do not exceed.
    """
    return {
        "median": _finite(np.median(values)),
        "p95": _finite(np.quantile(values, 0.95, method="inverted_cdf")),
        "max": _finite(max(values)),
    }


def _distributions(several: Sequence[Differences]) -> dict[str, Any]:
    return {
        measure: distribution(values)
        for measure, values in zip(Differences._fields, zip(*several, strict=True), strict=True)
    }


def _entry(verified: VerifiedRun) -> dict[str, Any]:
    case = verified.run.case
    return {
        "name": verified.run.name,
        "casing": case.casing,
        "E": _finite(case.E),
        "K": _finite(case.K),
        "theta": case.theta,
        "law": case.law,
        "f_omega": verified.run.f_omega,
        "status": verified.status,
        **_plain(verified.error),
        "spread": None if verified.spread is None else _plain(verified.spread),
        "sensitive": verified.sensitive,
    }


def _plain(several: Differences) -> dict[str, float | None]:
    return {measure: _finite(value) for measure, value in several._asdict().items()}


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
