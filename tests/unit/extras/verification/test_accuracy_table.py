"""The table of the errors of drawn runs."""

import math

from bladerub.extras.verification import accuracy
from bladerub.extras.verification.differences import Differences
from bladerub.extras.verification.verify import Seconds, StudyRun, VerifiedRun
from bladerub.study.grid import CoatingCase

RUNS = [StudyRun(CoatingCase("2nd", 2.0, 0.5, 0.15), 0.1 + 0.01 * number) for number in range(12)]


def verified(run):
    """A run that is beyond one percent, and sensitive, above 0.2."""
    beyond = run.f_omega > 0.2
    return VerifiedRun(
        run=run,
        status="completed",
        error=Differences(0.02, 0.001, 0.002) if beyond else Differences(0.001, 0.0, 0.0),
        against_paper=Differences(0.0, 0.0, 0.0),
        paper_uncertainty=Differences(0.0, 0.0, 0.0),
        spread=Differences(0.015, 0.0, 0.0) if beyond else None,
        energy_residual=1e-6,
        seconds=Seconds(0.1, 0.4, 1.0, 4.0),
        speedup=None if beyond else 200.0,
    )


def test_a_row_holds_errors_what_starts_change_and_cost(monkeypatch):
    monkeypatch.setattr(accuracy, "verify_runs", lambda blade, config, runs: map(verified, runs))
    lines = []
    table = accuracy.table(None, {}, {"all": RUNS, "important": RUNS[-2:]}, lines.append)
    assert len(lines) == len(table) == 3 * 12 + 2  # drawn thrice
    row = table[table.f_omega > 0.2].iloc[0]
    assert (row.E, row.K, row.theta, row.law, row.status) == (2.0, 0.5, 0.15, "theta", "completed")
    assert (row.error_wear_l2, row.error_revolution_peak, row.start_wear_l2) == (0.02, 0.002, 0.015)
    assert row.sensitive
    assert row.cpu_s == 0.1
    within = table[table.f_omega < 0.2].iloc[0]
    assert math.isnan(within.start_wear_l2)
    assert not within.sensitive
    assert within.speedup_at_equal_error == 200.0
