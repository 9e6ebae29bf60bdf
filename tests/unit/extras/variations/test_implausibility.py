import numpy as np
import pandas as pd
import pytest

from bladerub.extras.variations import implausibility
from bladerub.extras.variations.emulator import Emulator
from bladerub.extras.variations.targets import AT_LEAST, AT_MOST, EQUAL, TARGETS, Target

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
