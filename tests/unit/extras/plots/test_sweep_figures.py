import numpy as np
import pytest

from bladerub.extras.passages.sweeps import SpeedSweep
from bladerub.extras.plots.sweeps import sweeps
from bladerub.study.grid import CoatingCase
from bladerub.study.maps import CoatingMap

CASE = CoatingCase("2nd", 1.1, 0.5, 0.0)
SPEED = np.linspace(0.14, 0.4, 30)


def sweep(direction, rate, status="completed"):
    amplitude = 1e-3 * np.exp(-(((SPEED - 0.3) / 0.02) ** 2))
    if status == "unbounded":
        amplitude[20:] = np.nan
    speed = SPEED if direction == "up" else SPEED[::-1]
    none = np.empty((0, 3))
    return SpeedSweep(
        CASE, direction, rate, status, 1e-5, 1e-4, speed, amplitude, none[:, 0], none[:, 0], SPEED[:3], none
    )


@pytest.fixture
def constant():
    empty = np.empty((3, 0))
    return CoatingMap(
        *(CASE, np.array([0.2, 0.3, 0.4]), np.ones(3), empty[0], empty, None, empty[0], empty, empty),
        *(np.array([[1e-4, 2e-4], [1e-3, 2e-3], [1e-4, 9e-3]]), empty, np.zeros(3), np.zeros(3)),
        np.array(["completed", "completed", "unbounded"]),
    )


def test_a_sweep_is_drawn_by_direction_over_the_runs_at_constant_speed(draws, constant):
    drawn = [sweep("up", 0.05), sweep("down", 0.05), sweep("up", 0.2, "unbounded")]
    up, down = draws(sweeps(drawn, {CASE: constant})).axes
    np.testing.assert_allclose(up.lines[0].get_ydata(), [0.2, 2.0, 9.0])
    np.testing.assert_allclose(up.lines[3].get_xydata(), [[SPEED[19], up.lines[2].get_ydata()[19]]])
    assert len(down.lines) == 2
    np.testing.assert_allclose(down.lines[1].get_xdata(), SPEED[::-1])
    assert up.get_ylim()[1] == pytest.approx(1.08 * 2.0)  # the run that left all bounds is out of it
    assert up.get_xlim() == pytest.approx((0.14, 0.4))
