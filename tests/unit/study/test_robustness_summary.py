import numpy as np
import pandas as pd
import pytest

from bladerub.config_faults import UNKNOWN
from bladerub.config_files import Marked
from bladerub.study.robustness import summary
from bladerub.study.robustness.plan import Factor, Part, Plan

PLAN = Plan(
    seed=1,
    factors=(
        Factor("unit", "unit of E and K", "Pa", {"contact.modulus_unit": (1e8, 1e10)}, logarithmic=True),
        Factor("idle", "nothing", "1", {"contact.damping_ratio": (0.0, 1.0)}),
    ),
    parts={"lobes": Part("lobes", ("C2", "C3"), 64, Marked({}, UNKNOWN))},
)


@pytest.fixture
def verdicts(tmp_path):
    """C2a holds above the middle of the unit, C2b always; C3a is measurable in every second sample."""
    unit = PLAN.places()[:, 0]
    rows = [
        {"sample": number, "id": id_, "holds": holds, "margin": margin}
        for number in reversed(range(64))
        for id_, holds, margin in (
            ("C3a", "partly" if number % 4 else "no", float(number % 4)),
            ("C2b", "yes", np.inf),
            ("C2a", "yes" if unit[number] > 0.5 else "no", unit[number] - 0.5),
        )
        if id_ != "C3a" or number % 2 == 0
    ]
    paths = []
    for part, chunk in enumerate((rows[:50], rows[50:])):
        paths.append(tmp_path / f"{part}.csv")
        pd.DataFrame(chunk).to_csv(paths[-1], index=False)
    return summary.gather(paths)


def test_what_samples_say_is_ordered_by_claim_and_sample(verdicts):
    assert list(dict.fromkeys(verdicts.id)) == ["C2a", "C2b", "C3a"]
    assert list(verdicts["sample"][:64]) == list(range(64))


def test_the_factor_that_decides_is_found(verdicts):
    found = summary.sensitivities(PLAN, verdicts).set_index(["id", "output", "factor"])
    assert set(found.index.get_level_values("id")) == {"C2a", "C3a"}  # C2b is always the same
    assert found.loc[("C2a", "margin", "unit"), "total"] == pytest.approx(1, abs=0.02)
    assert found.loc[("C2a", "margin", "idle"), "total"] < 0.02
    assert found.loc[("C2a", "margin", "unit"), "predicted"] > 0.95
    assert found.loc[("C2a", "verdict", "unit"), "total"] > 0.9


def test_shares_and_cost_of_each_claim(verdicts):
    cost = pd.DataFrame({"part": "lobes", "sample": range(64), "runs": 40, "cpu_s": np.arange(64.0)})
    table = summary.summary(PLAN, verdicts, summary.sensitivities(PLAN, verdicts), cost).set_index("id")
    assert list(table.samples) == [64, 64, 32]
    assert list(table.yes_share) == [0.5, 1, 0]
    assert list(table.partly_share) == [0, 0, 0.5]
    assert list(table.no_share) == [0.5, 0, 0.5]
    assert table.decided_by["C2a"].startswith("unit ")
    assert table.decided_by["C2b"] == ""
    assert np.isnan(table.predicted["C2b"])
    assert (table.runs == 40).all()
    assert (table.cpu_s == 31.5).all()


def test_the_design_lists_the_value_of_each_factor():
    table = summary.design(PLAN)
    unit = table[table.factor == "unit"]
    assert len(unit) == 64
    assert unit.value.between(1e8, 1e10).all()
    assert set(table.unit[table.factor == "unit"]) == {"Pa"}
