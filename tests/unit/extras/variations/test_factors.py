import numpy as np
import pandas as pd
import pytest

from bladerub.config.errors import UNKNOWN
from bladerub.config.files import Located
from bladerub.extras.variations import implausibility
from bladerub.extras.variations.emulator import Emulator
from bladerub.extras.variations.factors import Factor, lay_over
from bladerub.extras.variations.figures import robustness
from bladerub.extras.variations.targets import AT_LEAST, AT_MOST, EQUAL, TARGETS, Target
from bladerub.extras.variations.verdicts import verdicts

UNIT = Factor("unit", "Pa", {"contact.modulus_unit": (1e8, 1e10)}, logarithmic=True)


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


@pytest.mark.parametrize(("position", "turns"), [(0.0, False), (0.49, False), (0.51, True), (1.0, True)])
def test_factors_set_numbers_and_switches(position, turns):
    varied = lay_over(Located.of(STUDY, UNKNOWN), (UNIT, DEPTH, TURNS), (1.0, 0.25, position)).plain()
    assert varied["contact"] == {"modulus_unit": pytest.approx(1e10), "tip_turns": turns}
    assert varied["casings"]["2nd"]["interference"] == pytest.approx(0.3)
    assert varied["casings"]["5nd"]["interference"] == pytest.approx(0.4)
    assert STUDY["contact"]["modulus_unit"] == 1e9


def test_shares_add_up_in_order_and_indices_fill_the_rows_of_what_varies():
    table = pd.DataFrame(
        {
            "id": ["C1a", "C2a", "C10b"],
            "yes_share": [1.0, 0.5, np.nan],
            "partly_share": [0.0, 0.2, np.nan],
            "no_share": [0.0, 0.3, np.nan],
            "predicted": [np.nan, 0.4, np.nan],
        }
    )
    indices = {"factor": ["unit", "lean"], "first": 0.0, "total": [0.3, 0.05], "predicted": 0.4}
    rows = [pd.DataFrame(indices).assign(id="C2a", output=output) for output in ("verdict", "margin")]
    shares, factors, *_ = robustness(table, pd.concat(rows)).axes
    widths = np.array([[bar.get_width() for bar in bars] for bars in shares.containers])
    assert widths[:, 1] == pytest.approx([50, 20, 30])
    assert [bars[1].get_x() for bars in shares.containers] == pytest.approx([0, 50, 70])
    (image,) = factors.collections
    values = np.ma.filled(image.get_array().astype(float), np.nan)
    assert values[1] == pytest.approx([0.3, 0.05])
    assert np.isnan(values[[0, 2]]).all()


def test_a_mark_for_each_verdict_and_none_where_there_is_none():
    said = {"study": ["yes", "no", np.nan], "stiff": ["yes", "partly", "yes"]}
    (axes,) = verdicts(pd.DataFrame(said, index=["C1a", "C2", "C3"])).axes
    marks = {each.get_label(): {tuple(at) for at in each.get_offsets()} for each in axes.collections}
    assert marks == {"yes": {(0, 0), (1, 0), (1, 2)}, "partly": {(1, 1)}, "no": {(0, 1)}}
    assert axes.yaxis_inverted()


KNOWN = {target.name: target for target in TARGETS}


@pytest.mark.parametrize(
    ("relation", "expected"), [(EQUAL, [0.2, 0.0, 0.3]), (AT_LEAST, [0.2, 0, 0]), (AT_MOST, [0, 0, 0.3])]
)
def test_a_target_is_missed_on_the_sides_of_its_relation(relation, expected):
    target = Target("speed", "C1a", relation, 1.0, 0.1, lambda evidence: 0.0)
    assert target.excess(np.array([0.8, 1.0, 1.3])) == pytest.approx(np.array(expected))
    assert np.isnan(target.excess(np.array([np.nan]))).all()


def test_quantities_become_a_row_a_set_in_the_order_of_the_targets():
    names = [TARGETS[3].name, TARGETS[1].name]
    long = pd.DataFrame({"set": [7, 7, 2, 2], "target": names * 2, "value": [1.0, 2.0, 3.0, 4.0]})
    table = implausibility.wide(long)
    assert list(table.columns) == names[::-1]
    assert list(table.index) == [2, 7]
    assert table.loc[7, names[0]] == 1.0


def test_the_deviation_of_a_prediction_makes_a_set_more_plausible():
    rng = np.random.default_rng(0)
    positions, target = rng.random((40, 2)), KNOWN["f4_soft"]
    far = target.value + 10 * target.error
    sure = implausibility.predicted({"f4_soft": Emulator(positions, np.full(40, far))}, positions[:3])
    assert sure.f4_soft.to_numpy() == pytest.approx(np.full(3, 10.0))
    scattered = far + 5 * target.error * rng.standard_normal(40)
    unsure = implausibility.predicted({"f4_soft": Emulator(positions, scattered)}, positions)
    assert unsure.f4_soft.median() < 4
