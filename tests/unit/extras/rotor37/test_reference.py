from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from bladerub.extras.rotor37 import numbers
from bladerub.extras.rotor37.reference import with_uncertainty


def measured(**values):
    return pd.DataFrame(
        [(name, value, "m", 0.3 if name == "speed" else 0.0) for name, value in values.items()],
        columns=numbers.COLUMNS,
    )


def test_uncertainty_is_the_root_of_the_sum_of_squares_of_changes_and_resolution():
    depths = {"reference": 1.0, "step": 1.3, "modes": 0.6, "nodes": 1.0}
    tables = {name: measured(depth=depth, speed=2.0, lost=1.0) for name, depth in depths.items()}
    table = with_uncertainty(tables | {"mesh": measured(depth=1.0, speed=2.4)}).set_index("number")
    assert table.uncertainty.to_dict() == pytest.approx({"depth": 0.5, "speed": 0.5})
    assert table.by_step["depth"] == pytest.approx(0.3)
    assert table.by_modes["depth"] == pytest.approx(-0.4)


def test_direct_contact_is_measured_over_the_last_five_revolutions():
    turned = np.arange(10 * 360) / 360 * 2 * np.pi
    displacement = 1e-4 * (2 * np.cos(4 * turned) - 0.5 * np.cos(6 * turned) - 1)
    displacement[: 5 * 360] = 1.0
    result = SimpleNamespace(radial_displacement=displacement, n_contact_steps=1, n_steps=4)
    found = numbers.of_direct_contact("rest", result, 10).set_index("number").value
    assert found["rest.order_4"] == pytest.approx(2e-4, rel=1e-6)
    assert found["rest.order_6"] == pytest.approx(0.5e-4, rel=1e-6)
    assert found["rest.highest"] == pytest.approx(displacement[-360:].max())
    assert found["rest.amplitude"] == pytest.approx(np.ptp(displacement[-360:]) / 2)
    assert found["rest.contact_share"] == 0.25
