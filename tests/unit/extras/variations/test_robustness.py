import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.extras.variations import job, waves
from bladerub.extras.variations import robustness as summary
from bladerub.extras.variations.factors import Factor
from bladerub.extras.variations.plan import Part, Plan

PLAN = Plan(
    seed=1,
    factors=(
        Factor("unit", "Pa", {"contact.modulus_unit": (1e8, 1e10)}, logarithmic=True),
        Factor("idle", "1", {"contact.damping_ratio": (0.0, 1.0), "contact.tip_profile.half_width": (0, 2)}),
    ),
    parts={"lobes": Part("lobes", (Located({}, UNKNOWN),), ("C2", "C3"), 64)},
    waves=(64,),
)


OF_C3A = [number for number in range(64) if number % 3 and number > 5]  # samples that can tell of C3a


@pytest.fixture
def verdicts(tmp_path):
    """C2a holds above the middle of the unit, C2b always, C3a below it where it can be told."""
    unit = waves.design(PLAN)[:, 0]
    rows = [{"set": -1, "id": id_, "holds": "partly", "margin": 0.0} for id_ in ("C2a", "C3a")]
    for number in reversed(range(64)):
        rows.append({"set": number, "id": "C2b", "holds": "yes", "margin": np.inf})
        high = unit[number] > 0.5
        margin = unit[number] if high else np.nan  # it fails because nothing is found
        rows.append({"set": number, "id": "C2a", "holds": "yes" if high else "no", "margin": margin})
        if number in OF_C3A:
            holds = "no" if high else "partly" if number % 2 else "yes"
            rows.append({"set": number, "id": "C3a", "holds": holds, "margin": -unit[number]})
    paths = [tmp_path / f"{part}.csv" for part in range(3)]
    for path, chunk in zip(paths, (rows[:50], rows[50:], []), strict=True):
        pd.DataFrame(chunk, columns=job.VERDICTS).to_csv(path, index=False)
    return summary.collect(paths)


def test_the_factor_that_decides_is_found(verdicts):
    found = summary.sensitivities(PLAN, verdicts).set_index(["id", "output", "factor"])
    assert set(found.index.get_level_values("id")) == {"C2a", "C3a"}  # C2b is always the same
    for id_ in ("C2a", "C3a"):
        assert found.loc[(id_, "verdict", "unit"), "total"] > 0.5
        assert found.loc[(id_, "margin", "unit"), "total"] > 0.85
        assert found.loc[(id_, "margin", "idle"), "total"] < 0.1


def test_shares_and_cost_of_each_claim(verdicts):
    cost = pd.DataFrame({"part": "lobes", "set": range(64), "runs": 40, "cpu_s": np.arange(64.0)})
    cost.loc[64] = ("lobes", -1, 1000, 1000.0)
    table = summary.summary(PLAN, verdicts, summary.sensitivities(PLAN, verdicts), cost).set_index("id")
    assert list(table.index) == ["C2a", "C2b", "C2c", "C2d", "C3a", "C3b", "C3c", "C3d"]
    assert list(table.samples) == [64, 64, 0, 0, len(OF_C3A), 0, 0, 0]
    assert table[["yes_share", "no_share"]][:2].to_numpy().tolist() == [[0.5, 0.5], [1, 0]]
    told = verdicts[(verdicts.id == "C3a") & (verdicts["sample"] >= 0)].holds
    for word in ("yes", "partly", "no"):
        assert table[f"{word}_share"]["C3a"] == (told == word).mean() > 0
    assert np.isnan(table.yes_share["C2c"])
    assert list(table.reference) == ["partly", "", "", "", "partly", "", "", ""]
    assert table.decided_by["C2a"].startswith("unit 0.")
    assert table.decided_by["C2b"] == ""
    assert np.isnan(table.predicted["C2b"])
    assert (table.runs_per_sample == 40).all()
    assert (table.cpu_s_per_sample == 31.5).all()


def test_the_design_lists_every_number_that_a_factor_sets():
    table = summary.design(PLAN)
    assert len(table) == 64 * 3
    value = {key: rows.value.to_numpy() for key, rows in table.groupby("key")}
    assert ((value["contact.modulus_unit"] >= 1e8) & (value["contact.modulus_unit"] <= 1e10)).all()
    assert set(table.unit[table.key == "contact.modulus_unit"]) == {"Pa"}
    doubled = pytest.approx(2 * value["contact.damping_ratio"])
    assert value["contact.tip_profile.half_width"] == doubled
