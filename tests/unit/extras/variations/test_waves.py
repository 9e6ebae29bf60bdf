import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.extras.variations import candidates, waves
from bladerub.extras.variations import identification as summary
from bladerub.extras.variations.emulator import Emulator, compared, held_out
from bladerub.extras.variations.factors import Factor
from bladerub.extras.variations.implausibility import predicted, without
from bladerub.extras.variations.plan import Candidates, Part, Plan
from bladerub.extras.variations.targets import TARGETS

TARGET = {target.name: target for target in TARGETS}
STUDY = {"contact": {"modulus_unit": 6e8}, "blade": {"hub_radius": 0.45}}
EMPTY = Located.of({}, UNKNOWN)


@pytest.fixture
def plan():
    return Plan(
        seed=5,
        factors=(
            Factor("unit", "Pa", {"contact.modulus_unit": (2e8, 1e9)}),
            Factor("hub", "m", {"blade.hub_radius": (0.3, 0.6)}),
        ),
        parts={"peaks": Part("peaks", (EMPTY,), ("C4",))},
        sets={"soft": {"unit": 2e8}},
        waves=(32, 8),
        remaining=0.01,
        candidates=Candidates(2, 3, 0.02, Part("candidates", (EMPTY,))),
    )


@pytest.fixture
def positions(plan):
    return waves.first(plan, STUDY)


@pytest.fixture
def measured(positions):
    """Targets that the sets near (0.3, 0.8) meet."""
    far = positions - np.array([0.3, 0.8])
    f4, f6 = TARGET["f4_soft"], TARGET["f6_soft"]
    return pd.DataFrame(
        {"f4_soft": f4.value + 40 * f4.error * far[:, 0], "f6_soft": f6.value + 40 * f6.error * far[:, 1]},
        index=pd.RangeIndex(len(positions), name="set"),
    )


@pytest.fixture
def emulated(positions, measured):
    return {name: Emulator(positions, values.to_numpy()) for name, values in measured.items()}


def test_the_first_wave_has_the_study_s_own_values_the_given_ones_and_a_spread(plan, positions):
    assert positions[0] == pytest.approx([0.5, 0.5])
    assert positions[1] == pytest.approx([0.0, 0.5])
    assert sorted((32 * positions[2:, 0]).astype(int)) == list(range(32))
    assert np.array_equal(positions, waves.first(plan, STUDY))


def test_what_is_left_lies_where_the_targets_are_met_and_the_next_sets_there_far_from_each_other(
    plan, emulated, positions, measured
):
    left = waves.remaining(plan, emulated)
    assert left.given_up == 0
    assert np.abs(left.points.mean(axis=0) - [0.3, 0.8]).max() < 0.05
    # three of 40 standard deviations on both sides, in both factors
    assert left.share == pytest.approx(0.15**2, rel=0.1)
    assert left.plausible["f4_soft"] == pytest.approx(0.15, rel=0.1)
    drawn = waves.draw(plan, 1, left, emulated, positions)
    assert len(drawn) == waves.DRAWN
    assert (without(predicted(emulated, drawn), left.given_up) <= 3).all()
    first = drawn[:8]
    apart = np.linalg.norm(first[:, None] - first, axis=2)[~np.eye(8, dtype=bool)]
    assert apart.min() > 0.02
    assert np.array_equal(drawn, waves.draw(plan, 1, left, emulated, positions))
    nowhere = measured.assign(f6_straight=TARGET["f6_straight"].value + 1.0)
    emulated = {name: Emulator(positions, values.to_numpy()) for name, values in nowhere.items()}
    left = waves.remaining(plan, emulated)
    assert left.given_up == 1
    assert left.share >= plan.remaining
    assert left.plausible["f6_straight"] == 0


def verdicts(**holds):
    table = pd.DataFrame(holds).replace({True: "yes", False: "no"}).rename_axis("set").reset_index()
    return table.melt("set", var_name="id", value_name="holds")


@pytest.fixture
def chosen(plan, positions, measured):
    """Two parts of which both hold in set 7, one in set 3 and in the nearest, and none in the others."""
    table = pd.DataFrame(positions, index=measured.index, columns=["unit", "hub"])
    sets = np.arange(len(positions))
    nearest = int(candidates.misfit(measured).idxmin())
    judged = verdicts(C4a=np.isin(sets, [3, 7]), C4b=np.isin(sets, [7, nearest]))
    return candidates.choose(plan, table, measured, judged)


def test_the_best_sets_and_their_neighbours_are_chosen_and_the_parts_that_hold_there_counted(
    chosen, measured, plan
):
    assert len(chosen) == 3 * 4
    themselves = chosen[chosen.neighbour == 0]
    assert themselves.set.iloc[0] == candidates.OWN
    misfit = candidates.misfit(measured)
    assert list(themselves.set[1:]) == [7, misfit.idxmin()]
    assert list(themselves.misfit) == list(misfit[themselves.set])
    for number in (0, 1, 2):
        itself, *others = chosen[chosen.candidate == number][["unit", "hub"]].to_numpy()
        moved = np.abs(np.array(others) - itself)
        assert (moved <= 0.02 + 1e-12).all()
        assert moved.max() == pytest.approx(0.02)
    long = candidates.as_table(plan, chosen)
    rows = [(0, "C4a", "yes"), (0, "C6a", "yes"), (0, "C1a", "yes"), (0, "C9a", "no")]
    rows += [(4, "C4a", "partly"), (4, "C6a", "no"), (4, "C1a", "yes"), (4, "C9a", "no")]
    judged = pd.DataFrame(rows, columns=["set", "id", "holds"]).assign(margin=0.0)
    counted = candidates.counts(long, candidates.verdicts(plan, judged))
    counted = counted.set_index(["candidate", "neighbour"])[["matched_yes", "predicted_yes", "yes", "parts"]]
    assert counted.loc[[(0, 0), (1, 0)]].to_numpy().tolist() == [[1, 1, 3, 4], [0, 0, 1, 4]]


def test_claims_that_hold_together_less_often_than_by_chance_exclude_each_other():
    rng = np.random.default_rng(0)
    one, other = rng.random((2, 400)) < 0.4
    holds = {"C4a": one, "C5a": ~one, "C8a": other, "C11a": rng.random(400) < 0.01}
    (pair,) = summary.exclusions(verdicts(**holds)).itertuples(index=False)
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
    assert held_out(emulator, PLACES, smooth(PLACES)).explained > 0.95
    noise = np.random.default_rng(4).standard_normal(60)
    assert held_out(Emulator(PLACES, noise), PLACES, noise).explained < 0.4
    rng = np.random.default_rng(3)
    emulator = Emulator(PLACES, smooth(PLACES) + 0.3 * rng.standard_normal(60))
    others = rng.random((400, 4))
    scattered = smooth(others) + 0.3 * rng.standard_normal(400)
    predicted = emulator.predict(others)
    assert 0.3 < np.median(predicted.deviation) < 0.6
    assert 0.85 < compared(scattered, predicted).within_two <= 1
