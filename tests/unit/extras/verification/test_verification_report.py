import json
import math

import pandas as pd
import pytest

from bladerub.extras.verification import accuracy
from bladerub.extras.verification.compare import compare
from bladerub.extras.verification.differences import Differences
from bladerub.extras.verification.report import report
from bladerub.extras.verification.verify import Seconds, StudyRun, VerifiedRun
from bladerub.study.grid import CoatingCase


def verified(f_omega, wear, peak=0.0, revolution_peak=0.0, **changes):
    error = Differences(wear, peak, revolution_peak)
    values = {
        "run": StudyRun(CoatingCase("2nd", 2.0, 0.5, 0.0), f_omega),
        "status": "completed",
        "error": error,
        "against_paper": Differences(0.02, 0.01, 0.01),
        "paper_uncertainty": Differences(0.01, 0.005, 0.005),
        "spread": Differences(0.001, 0.0, 0.0) if max(error) > 0.01 else None,
        "energy_residual": 1e-4,
        "seconds": Seconds(0.25, 1.0, 1.0, 4.0),
        "speedup": 7.0,
    }
    return VerifiedRun(**values | changes)


def test_runs_beyond_tolerance_the_worst_first():
    runs = [
        verified(0.1, 0.002),
        verified(0.2, 0.02, spread=Differences(0.015, 0.0, 0.0)),
        verified(0.3, 0.001, revolution_peak=0.03),
        verified(0.4, math.inf, math.inf, math.inf, status="unbounded", spread=None),
    ]
    figures = report(runs)
    assert [entry["f_omega"] for entry in figures["beyond"]] == [0.4, 0.3, 0.2]
    assert figures["within_1_percent"] == 0.5  # the peak of a revolution does not count
    assert figures["beyond"][2]["sensitive"]
    assert (figures["beyond"][0]["wear_l2"], figures["beyond"][0]["spread"]) == (None, None)
    json.dumps(figures, allow_nan=False)


KNOWN = pd.DataFrame(
    {"number": ["f1", "f2", "share"], "value": [100.0, 200.0, 0.25], "unit": ["Hz", "Hz", "1"]}
).assign(uncertainty=[0.5, 1.0, 0.0])


@pytest.mark.parametrize(
    ("f1", "uncertainty", "agrees"),
    [(100.999, None, True), (99.001, None, True), (101.001, None, False), (102.599, 1.2, True)],
)
def test_numbers_agree_within_twice_the_uncertainty_of_both(tmp_path, f1, uncertainty, agrees):
    own = KNOWN[["number", "value"]].assign(value=[f1, 200.0, 0.25])
    if uncertainty:
        own = own.assign(uncertainty=[uncertainty, 0.0, 0.0])
    for folder, table in (("reference", KNOWN), ("own", own)):
        (tmp_path / folder).mkdir()
        table.to_csv(tmp_path / folder / "blade.csv", index=False)
    found = compare(tmp_path / "own", tmp_path / "reference")
    assert found.agrees.tolist() == [agrees, True, True]
    assert found.number.tolist() == ["f1", "f2", "share"]
    assert found.allowed[0] == pytest.approx(2 * math.hypot(0.5, uncertainty or 0), rel=1e-3)


RUNS = [StudyRun(CoatingCase("2nd", 2.0, 0.5, 0.15), 0.1 + 0.01 * number) for number in range(12)]


def drawn(run):
    """A run that is beyond one percent, and sensitive, above 0.2."""
    if run.f_omega > 0.2:
        return verified(
            run.f_omega, 0.02, 0.001, 0.002, run=run, spread=Differences(0.015, 0.0, 0.0), speedup=None
        )
    return verified(run.f_omega, 0.001, run=run, speedup=200.0)


def test_a_row_holds_errors_what_starts_change_and_cost(monkeypatch):
    monkeypatch.setattr(accuracy, "verify_runs", lambda blade, config, runs: map(drawn, runs))
    lines = []
    table = accuracy.table(None, {}, {"all": RUNS, "important": RUNS[-2:]}, lines.append)
    assert len(lines) == len(table) == 3 * 12 + 2  # drawn thrice
    row = table[table.f_omega > 0.2].iloc[0]
    assert (row.E, row.K, row.theta, row.law, row.status) == (2.0, 0.5, 0.15, "theta", "completed")
    assert (row.error_wear_l2, row.error_revolution_peak, row.start_wear_l2) == (0.02, 0.002, 0.015)
    assert row.sensitive
    assert row.cpu_s == 0.25
    within = table[table.f_omega < 0.2].iloc[0]
    assert math.isnan(within.start_wear_l2)
    assert not within.sensitive
    assert within.speedup_at_equal_error == 200.0
