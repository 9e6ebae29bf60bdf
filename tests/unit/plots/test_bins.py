import numpy as np

from bladerub.plots import bins


def test_edges_lie_half_way():
    np.testing.assert_allclose(bins.edges([0.1, 0.2, 0.4]), [0.05, 0.15, 0.3, 0.5])


def test_an_extra_speed_opens_no_gap():
    speed_edges, rows = bins.with_gaps([0.18, 0.19, 0.197, 0.2], np.eye(4))
    np.testing.assert_allclose(speed_edges, [0.175, 0.185, 0.1935, 0.1985, 0.2015])
    np.testing.assert_array_equal(rows, np.eye(4))


def test_missing_speeds_stay_a_gap():
    speed_edges, rows = bins.with_gaps([0.1, 0.11, 0.12, 0.3, 0.31], np.arange(5.0)[:, None])
    np.testing.assert_allclose(speed_edges, [0.095, 0.105, 0.115, 0.13, 0.29, 0.305, 0.315])
    np.testing.assert_array_equal(rows[:, 0], [0, 1, 2, np.nan, 3, 4])
