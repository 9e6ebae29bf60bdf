from dataclasses import replace

import numpy as np
import pytest

from bladerub.plots.wear_map import wear_map


def test_depth_over_speed_and_angle(coating_map, draws):
    upper, lower, _ = draws(wear_map(coating_map)).axes
    mesh = upper.collections[0]
    np.testing.assert_allclose(mesh.get_array().reshape(40, 6), 1e3 * coating_map.wear.T)
    assert mesh.norm.vmin == 0
    assert upper.get_ylim() == (0, 360)
    np.testing.assert_allclose(mesh.get_coordinates()[:, 0, 1], np.arange(41) * 9.0, atol=1e-9)  # degrees
    assert lower.get_xlim() == pytest.approx((0, 0.375))
    assert lower.get_ylim()[0] == 0


def test_runs_that_ended_early_are_crossed(coating_map, draws):
    lower = draws(wear_map(coating_map)).axes[1]
    completed, early = lower.lines
    np.testing.assert_array_equal(completed.get_ydata(), [5, 5, 10, 5, 5])
    np.testing.assert_array_equal(early.get_xydata(), [[0.35, 4]])
    assert early.get_marker() == "x"


def test_speeds_that_were_not_run_stay_empty(coating_map, draws):
    speeds = np.array([0.1, 0.12, 0.14, 0.3, 0.32, 0.34])
    mesh = draws(wear_map(replace(coating_map, f_omega=speeds))).axes[0].collections[0]
    columns = mesh.get_array().reshape(40, 7).mask.all(axis=0)
    np.testing.assert_array_equal(columns, [False, False, False, True, False, False, False])
    edges = mesh.get_coordinates()[0, :, 0]
    np.testing.assert_allclose(edges, [0.09, 0.11, 0.13, 0.16, 0.28, 0.31, 0.33, 0.35])
