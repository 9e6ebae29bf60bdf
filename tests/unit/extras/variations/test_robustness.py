import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.extras.variations import implausibility, job, waves
from bladerub.extras.variations import robustness as summary
from bladerub.extras.variations.emulator import Emulator
from bladerub.extras.variations.factors import Factor, lay_over
from bladerub.extras.variations.figures import robustness
from bladerub.extras.variations.plan import Part, Plan
from bladerub.extras.variations.targets import AT_LEAST, AT_MOST, EQUAL, TARGETS, Target
from bladerub.extras.variations.verdicts import verdicts as marks_of

UNIT = Factor("unit", "Pa", {"contact.modulus_unit": (1e8, 1e10)}, logarithmic=True)
IDLE = Factor("idle", "1", {"contact.damping_ratio": (0.0, 1.0), "contact.tip_profile.half_width": (0, 2)})
LOBES = {"lobes": Part("lobes", (Located({}, UNKNOWN),), ("C2", "C3"), 64)}
PLAN = Plan(LOBES, (UNIT, IDLE), seed=1, waves=(64,))


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


def test_the_factor_that_decides_shares_and_cost_of_each_claim_and_the_design_are_listed(verdicts):
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
    assert table[["runs_per_sample", "cpu_s_per_sample"]].eq([40, 31.5]).all(axis=None)
    found = summary.sensitivities(PLAN, verdicts).set_index(["id", "output", "factor"])
    assert set(found.index.get_level_values("id")) == {"C2a", "C3a"}  # C2b is always the same
    for id_ in ("C2a", "C3a"):
        assert found.loc[(id_, "verdict", "unit"), "total"] > 0.5
        assert found.loc[(id_, "margin", "unit"), "total"] > 0.85
        assert found.loc[(id_, "margin", "idle"), "total"] < 0.1
    table = summary.design(PLAN)
    assert len(table) == 64 * 3
    value = {key: rows.value.to_numpy() for key, rows in table.groupby("key")}
    assert 1e8 <= value["contact.modulus_unit"].min() < value["contact.modulus_unit"].max() <= 1e10
    assert set(table.unit[table.key == "contact.modulus_unit"]) == {"Pa"}
    doubled = pytest.approx(2 * value["contact.damping_ratio"])
    assert value["contact.tip_profile.half_width"] == doubled


DEPTH = Factor("depth", "m", {"casings.2nd.interference": (0.2, 0.6), "casings.5nd.interference": (0.3, 0.7)})
TURNS = Factor("turns", "1", {"contact.tip_turns": (0.0, 1.0)}, multiple_of=1.0)
STUDY = {
    "contact": {"modulus_unit": 1e9, "tip_turns": False},
    "casings": {"2nd": {"interference": 0.5}, "5nd": {"interference": 0.4}},
}


@pytest.mark.parametrize(("factor", "fraction"), [(UNIT, 0.5), (DEPTH, 0.75), (TURNS, 0.0)])
def test_own_value_lies_at_its_fraction_of_the_range(factor, fraction):
    assert factor.position(factor.own(STUDY)) == pytest.approx(fraction)
    assert factor.first_value(fraction) == pytest.approx(factor.own(STUDY))


@pytest.mark.parametrize(("position", "turns"), [(0.49, False), (0.51, True)])
def test_factors_set_numbers_and_switches(position, turns):
    varied = lay_over(Located.of(STUDY, UNKNOWN), (UNIT, DEPTH, TURNS), (1.0, 0.25, position)).plain()
    assert varied["contact"] == {"modulus_unit": pytest.approx(1e10), "tip_turns": turns}
    assert varied["casings"]["2nd"]["interference"] == pytest.approx(0.3)
    assert varied["casings"]["5nd"]["interference"] == pytest.approx(0.4)
    assert STUDY["contact"]["modulus_unit"] == 1e9


def test_shares_add_up_in_order():
    columns = ["id", "yes_share", "partly_share", "no_share", "predicted"]
    rows = [("C1a", 1.0, 0.0, 0.0, np.nan), ("C2a", 0.5, 0.2, 0.3, 0.4), ("C10b", *4 * [np.nan])]
    table = pd.DataFrame(rows, columns=columns)
    indices = {"factor": ["unit", "lean"], "first": 0.0, "total": [0.3, 0.05], "predicted": 0.4}
    rows = [pd.DataFrame(indices).assign(id="C2a", output=output) for output in ("verdict", "margin")]
    shares, *_ = robustness(table, pd.concat(rows)).axes
    widths = np.array([[bar.get_width() for bar in bars] for bars in shares.containers])
    assert widths[:, 1] == pytest.approx([50, 20, 30])
    assert [bars[1].get_x() for bars in shares.containers] == pytest.approx([0, 50, 70])


def test_a_mark_for_each_verdict_and_none_where_there_is_none():
    said = {"study": ["yes", "no", np.nan], "stiff": ["yes", "partly", "yes"]}
    (axes,) = marks_of(pd.DataFrame(said, index=["C1a", "C2", "C3"])).axes
    marks = {each.get_label(): {tuple(at) for at in each.get_offsets()} for each in axes.collections}
    assert marks == {"yes": {(0, 0), (1, 0), (1, 2)}, "partly": {(1, 1)}, "no": {(0, 1)}}


@pytest.mark.parametrize(
    ("relation", "expected"), [(EQUAL, [0.2, 0.0, 0.3]), (AT_LEAST, [0.2, 0, 0]), (AT_MOST, [0, 0, 0.3])]
)
def test_a_target_is_missed_on_the_sides_of_its_relation(relation, expected):
    target = Target("speed", "C1a", relation, 1.0, 0.1, lambda evidence: 0.0)
    assert target.excess(np.array([0.8, 1.0, 1.3])) == pytest.approx(np.array(expected))
    assert np.isnan(target.excess(np.array([np.nan]))).all()


def test_the_deviation_of_a_prediction_makes_a_set_more_plausible_and_quantities_become_a_row_a_set():
    rng = np.random.default_rng(0)
    positions = rng.random((40, 2))
    (target,) = [target for target in TARGETS if target.name == "f4_soft"]
    far = target.value + 10 * target.error
    sure = implausibility.predicted({"f4_soft": Emulator(positions, np.full(40, far))}, positions[:3])
    assert sure.f4_soft.to_numpy() == pytest.approx(np.full(3, 10.0))
    scattered = far + 5 * target.error * rng.standard_normal(40)
    unsure = implausibility.predicted({"f4_soft": Emulator(positions, scattered)}, positions)
    assert unsure.f4_soft.median() < 4
    names = [TARGETS[3].name, TARGETS[1].name]
    long = pd.DataFrame({"set": [7, 7, 2, 2], "target": names * 2, "value": [1.0, 2.0, 3.0, 4.0]})
    table = implausibility.wide(long)
    assert list(table.columns) == names[::-1]
    assert list(table.index) == [2, 7]
    assert table.loc[7, names[0]] == 1.0
