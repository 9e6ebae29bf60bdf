import math

import numpy as np
import pandas as pd

from bladerub.extras.verification import rigid_casing
from bladerub.study.peaks import COLUMNS


def test_each_peak_and_a_plain_speed_is_repeated_and_compared_with_the_run_of_the_study(
    blade, config, make_result, monkeypatch
):
    def simulate(_, spec, modes, how):
        return make_result(amplitude=2e-3 if how.treatment == "massless" else 1e-3, depth=0.0), how.finer

    monkeypatch.setattr(rigid_casing, "_simulate", simulate)
    peaks = pd.DataFrame(
        [
            ["2nd", math.inf, math.inf, 0.0, 4, 0.388, 1e-3, "coulomb"],
            ["2nd", 2.0, 0.5, 0.0, 4, 0.3, 1e-3, "theta"],
        ],
        columns=COLUMNS,
    )
    table = rigid_casing.table(blade, config, peaks)
    assert table.columns.tolist() == rigid_casing.COLUMNS
    assert sorted(table.f_omega.unique()) == [0.25, 0.384, 0.386, 0.388, 0.39, 0.392]
    assert set(table.order) == {4}
    own = table[(table.treatment == "exponential") & (table.steps == 1)]
    np.testing.assert_allclose(own.amplitude_change, 0, atol=1e-12)
    massless = table[table.treatment == "massless"]
    np.testing.assert_allclose(massless.amplitude_change, 1, atol=1e-9)
    assert massless.complete.all()
    assert not table[(table.treatment == "moreau_jean_0") & (table.modes == 10)].complete.any()
