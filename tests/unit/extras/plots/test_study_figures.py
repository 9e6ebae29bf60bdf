import numpy as np
import pandas as pd
import pytest

from bladerub.extras.plots.friction import NONE, friction
from bladerub.extras.plots.steps import steps


def test_errors_stand_over_steps_and_chaotic_runs_are_left_out():
    tolerances, counts = [0.03, 0.01, np.nan], [2e3, 4e3, 8e3]
    runs = [
        {"E": E, "tolerance": tolerance, "steps_per_revolution": count, "error": error, "sensitive": chaotic}
        for tolerance, count in zip(tolerances, counts, strict=True)
        for E, error, chaotic in [
            (2.0, 1e-3, False),
            (2.0, 3e-3, False),
            (2.0, 0.5, True),
            (np.inf, 1e-4, False),
        ]
    ]
    median, most = steps(pd.DataFrame(runs)).axes
    of_E2 = next(line for line in median.get_lines() if line.get_label() == "E = 2")
    np.testing.assert_allclose(of_E2.get_xdata(), [4e3, 2e3])
    np.testing.assert_allclose(of_E2.get_ydata(), 2e-3)
    of_E2 = next(line for line in most.get_lines() if line.get_label() == "E = 2")
    np.testing.assert_allclose(of_E2.get_ydata(), 2.8e-3)
    uniform = [line for line in median.get_lines() if line.get_marker() == "x"]
    assert [line.get_xdata().tolist() for line in uniform] == [[8e3], [8e3]]


def test_differences_by_friction_stand_over_the_speed():
    coating = {"casing": "2nd", "E": 2.0, "K": 0.5, "theta": 0.15}
    table = pd.DataFrame(
        [
            coating | {"f_omega": 0.15, "difference": -2e-3, "slowest_sliding": 0.4},
            coating | {"f_omega": 0.19, "difference": 0.0, "slowest_sliding": -0.1},
        ]
    )
    difference, sliding = friction(table).axes
    np.testing.assert_allclose(difference.get_lines()[0].get_ydata(), [2e-3, NONE])
    np.testing.assert_allclose(sliding.get_lines()[0].get_ydata(), [0.4, -0.1])
    assert sliding.get_ylim()[0] == pytest.approx(-0.11)
