import numpy as np
import pandas as pd
import pytest
from study_fixtures import CONFIG, changed

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.config.read import vary
from bladerub.extras.variations import identification, job, waves
from bladerub.extras.variations import robustness as summary
from bladerub.extras.variations.emulator import Emulator, compared, held_out
from bladerub.extras.variations.figures import robustness
from bladerub.extras.variations.plan import Part, Plan
from bladerub.extras.variations.settings import CandidateSettings, Factor
from bladerub.extras.variations.targets import AT_LEAST, AT_MOST, EQUAL, TARGETS, Target

UNIT = Factor(unit="Pa", sets={"contact.modulus_unit": [1e8, 1e10]}, scale="log")
OF_IDLE = {"contact.damping_ratio": [0.0, 1.0], "contact.tip_profile.half_width": [0, 2]}
FACTORS = {"unit": UNIT, "idle": Factor(unit="1", sets=OF_IDLE)}
LOBES = {"lobes": Part("lobes", (Located({}, UNKNOWN),), ("C2", "C3"), 64)}
PLAN = Plan(LOBES, FACTORS, seed=1, waves=(64,))


OF_C3A = [number for number in range(64) if number % 3 and number > 5]  # samples that can tell of C3a


@pytest.fixture
def verdicts(tmp_path):
    """C2a holds above the middle of the unit, C2b always, C3a below it where it can be told."""
    unit, number = waves.design(PLAN)[:, 0], np.arange(64)
    high = unit > 0.5
    always = pd.DataFrame({"set": number, "id": "C2b", "holds": "yes", "margin": np.inf})
    margin = np.where(high, unit, np.nan)  # it fails because nothing is found
    above = always.assign(id="C2a", holds=np.where(high, "yes", "no"), margin=margin)
    holds = np.where(high, "no", np.where(number % 2, "partly", "yes"))
    below = always.assign(id="C3a", holds=holds, margin=-unit).loc[OF_C3A]
    reference = pd.DataFrame({"set": -1, "id": ["C2a", "C3a"], "holds": "partly", "margin": 0.0})
    table = pd.concat([always, above, below, reference]).reindex(columns=job.VERDICTS)[::-1]
    paths = [tmp_path / f"{part}.csv" for part in range(3)]
    for path, chunk in zip(paths, (table[:50], table[50:], table[:0]), strict=True):
        chunk.to_csv(path, index=False)
    return summary.collect(paths)


def test_the_factor_that_decides_shares_and_cost_of_each_claim_and_the_design_are_listed(verdicts):
    cost = pd.DataFrame({"part": "lobes", "set": range(64), "runs": 40, "cpu_s": np.arange(64.0)})
    cost.loc[64] = ("lobes", -1, 1000, 1000.0)
    table = summary.summary(PLAN, verdicts, summary.sensitivities(PLAN, verdicts), cost).set_index("id")
    assert list(table.index) == ["C2a", "C2b", "C2c", "C2d", "C3a", "C3b", "C3c", "C3d"]
    assert list(table.samples) == [64, 64, 0, 0, len(OF_C3A), 0, 0, 0]
    assert table[["yes_share", "no_share"]][:2].to_numpy().tolist() == [[0.5, 0.5], [1, 0]]
    assert np.isnan(table.yes_share["C2c"])
    assert list(table.reference) == ["partly", "", "", "", "partly", "", "", ""]
    assert table.decided_by["C2a"].startswith("unit 0.")
    assert table.decided_by["C2b"] == ""
    assert table[["runs_per_sample", "cpu_s_per_sample"]].eq([40, 31.5]).all(axis=None)
    found = summary.sensitivities(PLAN, verdicts).set_index(["id", "output", "factor"])
    assert set(found.index.get_level_values("id")) == {"C2a", "C3a"}  # C2b is always the same
    for id_ in ("C2a", "C3a"):
        assert found.loc[(id_, "verdict", "unit"), "total"] > 0.5
        assert found.loc[(id_, "margin", "unit"), "total"] > 0.85
        assert found.loc[(id_, "margin", "idle"), "total"] < 0.1
    robustness(table.reset_index(), found.reset_index()).draw_without_rendering()
    value = {key: rows.value.to_numpy() for key, rows in summary.design(PLAN).groupby("key")}
    assert 1e8 <= value["contact.modulus_unit"].min() < value["contact.modulus_unit"].max() <= 1e10
    assert value["contact.tip_profile.half_width"] == pytest.approx(2 * value["contact.damping_ratio"])


DEPTHS = {"casings.2nd.interference": [2e-3, 6e-3], "casings.2nd5nd.interference": [3e-3, 7e-3]}
DEPTH = Factor(unit="m", sets=DEPTHS)
TURNS = Factor(unit="1", sets={"contact.tip_turns": [0.0, 1.0]}, multiple_of=1.0)
CASINGS = {"2nd": {"interference": 5e-3}, "2nd5nd": {"interference": 4e-3}}
STUDY = changed(CONFIG, contact={"modulus_unit": 1e9, "tip_turns": False}, casings=CASINGS)


def test_factors_set_numbers_and_switches_and_own_values_lie_at_their_fraction_of_the_range():
    for factor, fraction in ((UNIT, 0.5), (DEPTH, 0.75), (TURNS, 0.0)):
        assert factor.position(factor.own(STUDY)) == pytest.approx(fraction)
        assert factor.first_value(fraction) == pytest.approx(factor.own(STUDY))
    plan = Plan({}, {"unit": UNIT, "depth": DEPTH, "turns": TURNS})
    for position, turns in ((0.49, False), (0.51, True)):
        varied = plan.lay_over(vary(STUDY), (1.0, 0.25, position)).plain()
        assert varied["contact"]["modulus_unit"] == pytest.approx(1e10)
        assert varied["contact"]["tip_turns"] is turns
    assert varied["casings"]["2nd"]["interference"] == pytest.approx(3e-3)
    assert varied["casings"]["2nd5nd"]["interference"] == pytest.approx(4e-3)


@pytest.mark.parametrize(
    ("relation", "expected"), [(EQUAL, [0.2, 0.0, 0.3]), (AT_LEAST, [0.2, 0, 0]), (AT_MOST, [0, 0, 0.3])]
)
def test_a_target_is_missed_on_the_sides_of_its_relation(relation, expected):
    target = Target("speed", "C1a", relation, 1.0, 0.1, lambda evidence: 0.0)
    assert target.excess(np.array([0.8, 1.0, 1.3])) == pytest.approx(np.array(expected))
    assert np.isnan(target.excess(np.array([np.nan]))).all()


def test_the_deviation_of_a_prediction_makes_a_set_more_plausible_and_quantities_are_a_row_a_set(tmp_path):
    rng = np.random.default_rng(0)
    positions = rng.random((40, 2))
    target = TARGETS["f4_soft"]
    far = target.value + 10 * target.error
    sure = waves.predicted_implausibility({"f4_soft": Emulator(positions, np.full(40, far))}, positions[:3])
    assert sure.f4_soft.to_numpy() == pytest.approx(np.full(3, 10.0))
    scattered = far + 5 * target.error * rng.standard_normal(40)
    unsure = waves.predicted_implausibility({"f4_soft": Emulator(positions, scattered)}, positions)
    assert unsure.f4_soft.median() < 4
    names = list(TARGETS)[3:0:-2]
    long = pd.DataFrame({"set": [7, 7, 2, 2], "target": names * 2, "value": [1.0, 2.0, 3.0, 4.0]})
    long.to_csv(tmp_path / "quantities.csv", index=False)
    table = identification.measured([tmp_path / "quantities.csv"])
    assert list(table.columns) == names[::-1]
    assert list(table.index) == [2, 7]
    assert table.loc[7, names[0]] == 1.0


OWN_STUDY = changed(CONFIG, contact={"modulus_unit": 6e8}, blade={"hub_radius": 0.45})
EMPTY = Located.of({}, UNKNOWN)


@pytest.fixture
def plan():
    unit = Factor(unit="Pa", sets={"contact.modulus_unit": [2e8, 1e9]})
    hub = Factor(unit="m", sets={"blade.hub_radius": [0.3, 0.6]})
    peaks, finer = Part("peaks", (EMPTY,), ("C4",)), Part("candidates", (EMPTY,))
    best = CandidateSettings(number=2, neighbours=3, shift=0.02, study={})
    chosen = {"sets": {"soft": {"unit": 2e8}}, "candidates": best, "finer": finer}
    return Plan({"peaks": peaks}, {"unit": unit, "hub": hub}, seed=5, waves=(32, 8), remaining=0.01, **chosen)


@pytest.fixture
def positions(plan):
    return waves.first(plan, OWN_STUDY)


@pytest.fixture
def measured(positions):
    """Targets that the sets near (0.3, 0.8) meet."""
    far = positions - np.array([0.3, 0.8])
    f4, f6 = TARGETS["f4_soft"], TARGETS["f6_soft"]
    return pd.DataFrame(
        {"f4_soft": f4.value + 40 * f4.error * far[:, 0], "f6_soft": f6.value + 40 * f6.error * far[:, 1]},
        index=pd.RangeIndex(len(positions), name="set"),
    )


def emulated(positions, measured):
    return {name: Emulator(positions, values.to_numpy()) for name, values in measured.items()}


def test_the_first_wave_has_the_study_s_own_values_the_given_ones_and_a_spread(plan, positions):
    assert positions[0] == pytest.approx([0.5, 0.5])
    assert positions[1] == pytest.approx([0.0, 0.5])
    assert sorted((32 * positions[2:, 0]).astype(int)) == list(range(32))
    assert np.array_equal(positions, waves.first(plan, OWN_STUDY))


def test_what_is_left_lies_where_the_targets_are_met_and_the_next_sets_there_far_from_each_other(
    plan, positions, measured
):
    emulators = emulated(positions, measured)
    left = waves.remaining(plan, emulators)
    assert left.given_up == 0
    assert np.abs(left.points.mean(axis=0) - [0.3, 0.8]).max() < 0.05
    # three of 40 standard deviations on both sides, in both factors
    assert left.share == pytest.approx(0.15**2, rel=0.1)
    assert left.plausible["f4_soft"] == pytest.approx(0.15, rel=0.1)
    drawn = waves.draw(plan, 1, left, emulators, positions)
    assert len(drawn) == waves.DRAWN
    misses = waves.predicted_implausibility(emulators, drawn)
    assert (waves.worst(misses, left.given_up) <= 3).all()
    first = drawn[:8]
    apart = np.linalg.norm(first[:, None] - first, axis=2)[~np.eye(8, dtype=bool)]
    assert apart.min() > 0.02
    assert np.array_equal(drawn, waves.draw(plan, 1, left, emulators, positions))
    nowhere = measured.assign(f6_straight=TARGETS["f6_straight"].value + 1.0)
    left = waves.remaining(plan, emulated(positions, nowhere))
    assert left.given_up == 1
    assert left.share >= plan.remaining
    assert left.plausible["f6_straight"] == 0


def verdicts_of(**holds):
    table = pd.DataFrame(holds).replace({True: "yes", False: "no"}).rename_axis("set").reset_index()
    return table.melt("set", var_name="id", value_name="holds")


def test_the_best_sets_and_their_neighbours_are_chosen_and_the_parts_that_hold_there_counted(
    plan, positions, measured
):
    """Of two parts both hold in set 7, one in set 3 and in the nearest, and none in the others."""
    table = pd.DataFrame(positions, index=measured.index, columns=["unit", "hub"])
    sets, misfit = np.arange(len(positions)), waves.misfit(measured)
    nearest = int(misfit.idxmin())
    judged = verdicts_of(C4a=np.isin(sets, [3, 7]), C4b=np.isin(sets, [7, nearest]))
    chosen = waves.choose(plan, table, measured, judged).reset_index()
    assert len(chosen) == 3 * 4
    themselves = chosen[chosen.neighbour == 0]
    assert themselves.set.iloc[0] == waves.OWN
    assert list(themselves.set[1:]) == [7, nearest]
    assert list(themselves.misfit) == list(misfit[themselves.set])
    for number in (0, 1, 2):
        itself, *others = chosen[chosen.candidate == number][["unit", "hub"]].to_numpy()
        moved = np.abs(np.array(others) - itself)
        assert (moved <= 0.02 + 1e-12).all()
        assert moved.max() == pytest.approx(0.02)
    long = waves.with_values(plan, chosen.set_index(waves.CANDIDATES))
    rows = [(0, "C4a", "yes"), (0, "C6a", "yes"), (0, "C1a", "yes"), (0, "C9a", "no")]
    rows += [(4, "C4a", "partly"), (4, "C6a", "no"), (4, "C1a", "yes"), (4, "C9a", "no")]
    judged = pd.DataFrame(rows, columns=["set", "id", "holds"]).assign(margin=0.0)
    counted = identification.counts(long, identification.of_candidates(plan, judged))
    counted = counted.set_index(["candidate", "neighbour"])[["matched_yes", "predicted_yes", "yes", "parts"]]
    assert counted.loc[[(0, 0), (1, 0)]].to_numpy().tolist() == [[1, 1, 3, 4], [0, 0, 1, 4]]


def test_claims_that_hold_together_less_often_than_by_chance_exclude_each_other():
    rng = np.random.default_rng(0)
    one, other = rng.random((2, 400)) < 0.4
    holds = {"C4a": one, "C5a": ~one, "C8a": other, "C11a": rng.random(400) < 0.01}
    (pair,) = identification.exclusions(verdicts_of(**holds)).itertuples(index=False)
    assert {pair.id, pair.other_id} == {"C4a", "C5a"}
    assert pair.both == 0
    assert pair.by_chance == pytest.approx(pair.share * pair.other_share)


def smooth(x):
    return np.sin(4 * x[:, 0]) + x[:, 1] * x[:, 2]


PLACES = np.random.default_rng(1).random((60, 4))


def test_a_smooth_function_is_predicted_between_the_sets_and_noise_is_not():
    emulator = Emulator(PLACES, smooth(PLACES))
    others = np.random.default_rng(2).random((200, 4))
    found = compared(smooth(others), emulator.predict(others))
    assert found.explained > 0.98
    assert found.within_two > 0.8
    assert held_out(emulator).explained > 0.95
    noise = np.random.default_rng(4).standard_normal(60)
    assert held_out(Emulator(PLACES, noise)).explained < 0.4
    rng = np.random.default_rng(3)
    emulator = Emulator(PLACES, smooth(PLACES) + 0.3 * rng.standard_normal(60))
    others = rng.random((400, 4))
    scattered = smooth(others) + 0.3 * rng.standard_normal(400)
    predicted = emulator.predict(others)
    assert 0.3 < np.median(predicted.deviation) < 0.6
    assert 0.85 < compared(scattered, predicted).within_two <= 1
