"""The report on the errors of many runs: how they are distributed, and which runs are beyond tolerance."""

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from bladerub.extras.verification.differences import Differences
from bladerub.extras.verification.verify import TOLERANCE, Seconds, VerifiedRun
from bladerub.io.plain import plain


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
        "beyond": plain([_entry(run) for run in beyond]),
    }


def distribution(values: Sequence[float]) -> dict[str, float | None]:
    """Median, smallest value that at least 95 % of the values do not exceed, and maximum."""
    p95 = np.quantile(values, 0.95, method="inverted_cdf")
    return plain({"median": np.median(values), "p95": p95, "max": max(values)})


def _distributions(several: Sequence[Differences]) -> dict[str, Any]:
    by_measure = zip(Differences._fields, zip(*several, strict=True), strict=True)
    return {measure: distribution(values) for measure, values in by_measure}


def _entry(verified: VerifiedRun) -> dict[str, Any]:
    return {
        "name": verified.run.name,
        **asdict(verified.run.case),
        "f_omega": verified.run.f_omega,
        "status": verified.status,
        **verified.error._asdict(),
        "spread": verified.spread and verified.spread._asdict(),
        "sensitive": verified.is_sensitive,
    }
