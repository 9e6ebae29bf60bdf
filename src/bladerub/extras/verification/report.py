"""The report on the errors of many runs: how they are distributed, and which runs are beyond tolerance."""

import math
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from bladerub.extras.verification.differences import Differences
from bladerub.extras.verification.verify import TOLERANCE, Seconds, VerifiedRun


def report(verified: Sequence[VerifiedRun]) -> dict[str, Any]:
    """Summarise the errors of one run or more, in plain values that JSON can hold; infinite ones are None.

    ``n``, and ``within_1_percent``, the fraction within `TOLERANCE` in wear and spectral peak; ``wear_l2``,
    ``peak``, ``revolution_peak``, ``energy_residual``, each from `distribution`; ``worst``, the name of the
    worst run in each of the first three; ``against_paper_scheme``, the three for the differences from the
    paper's scheme, and under ``uncertainty`` the three for its own error; ``speedup_at_equal_error``, the
    median over the runs that have one and are not sensitive, and ``left_out``, how many runs are not in that
    median; ``seconds``, mean cost of a run of each kind; ``beyond``, the runs beyond `TOLERANCE` in any of
    the three, the worst first.
    """
    within = [max(run.error.wear_l2, run.error.peak) <= TOLERANCE for run in verified]
    speedups = [run.speedup for run in verified if run.speedup is not None and not run.is_sensitive]
    beyond = sorted((run for run in verified if run.is_beyond), key=lambda run: -max(run.error))
    return {
        "n": len(verified),
        "within_1_percent": float(np.mean(within)),
        **_distributions([run.error for run in verified]),
        "energy_residual": distribution([run.energy_residual for run in verified]),
        "worst": {
            measure: max(verified, key=lambda run: getattr(run.error, measure)).run.name
            for measure in Differences._fields
        },
        "against_paper_scheme": _distributions([run.against_paper for run in verified])
        | {"uncertainty": _distributions([run.paper_uncertainty for run in verified])},
        "speedup_at_equal_error": float(np.median(speedups)) if speedups else None,
        "left_out": len(verified) - len(speedups),
        "seconds": Seconds(*np.mean([run.seconds for run in verified], axis=0).tolist())._asdict(),
        "beyond": [_entry(run) for run in beyond],
    }


def distribution(values: Sequence[float]) -> dict[str, float | None]:
    """Median, smallest value that at least 95 % of the values do not exceed, and maximum."""
    return {
        "median": _finite(np.median(values)),
        "p95": _finite(np.quantile(values, 0.95, method="inverted_cdf")),
        "max": _finite(max(values)),
    }


def _distributions(several: Sequence[Differences]) -> dict[str, Any]:
    by_measure = zip(Differences._fields, zip(*several, strict=True), strict=True)
    return {measure: distribution(values) for measure, values in by_measure}


def _entry(verified: VerifiedRun) -> dict[str, Any]:
    case = asdict(verified.run.case)
    return {
        "name": verified.run.name,
        **case | {modulus: _finite(case[modulus]) for modulus in ("E", "K")},
        "f_omega": verified.run.f_omega,
        "status": verified.status,
        **_plain(verified.error),
        "spread": None if verified.spread is None else _plain(verified.spread),
        "sensitive": verified.is_sensitive,
    }


def _plain(several: Differences) -> dict[str, float | None]:
    return {measure: _finite(value) for measure, value in several._asdict().items()}


def _finite(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
