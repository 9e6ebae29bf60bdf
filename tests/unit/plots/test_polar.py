from dataclasses import replace

import numpy as np
import pytest

from bladerub.plots.polar import casing_polar, wear_profiles
from bladerub.study.grid import CoatingCase

ANGLE = np.linspace(0, 2 * np.pi, 60, endpoint=False)


def test_casing_is_magnified_inward(draws):
    inward = {"2": 1e-3 * np.cos(2 * ANGLE), "5": 1e-3 * np.cos(5 * ANGLE)}
    (axes,) = draws(casing_polar(ANGLE, inward, radius=0.65, magnification=100)).axes
    circle, two, five = axes.lines
    np.testing.assert_allclose(circle.get_ydata(), 0.65)
    np.testing.assert_allclose(two.get_ydata()[:-1], 0.65 - 0.1 * np.cos(2 * ANGLE))
    np.testing.assert_allclose(five.get_ydata()[:-1], 0.65 - 0.1 * np.cos(5 * ANGLE))
    for line in axes.lines:  # closed
        angle, radius = line.get_data()
        assert angle[-1] - angle[0] == pytest.approx(2 * np.pi)
        assert radius[-1] == radius[0]


def test_wear_is_that_of_the_speeds_asked_for(coating_map, draws):
    straight = replace(coating_map, case=CoatingCase("2nd", 2.0, 0.5, 0.0), wear=2 * coating_map.wear)
    table, figure = wear_profiles([straight, coating_map], [0.15, 0.3])
    assert list(table.columns) == ["f_omega", "theta", "angle", "wear"]
    for theta, coating in ((0.0, straight), (0.15, coating_map)):
        rows = table[(table.f_omega == 0.3) & (table.theta == theta)]
        np.testing.assert_array_equal(rows[["angle", "wear"]], np.transpose([coating.angle, coating.wear[4]]))
    first, second = draws(figure).axes
    assert len(first.lines) == len(second.lines)
    np.testing.assert_allclose(second.lines[0].get_ydata()[:-1], 1e3 * straight.wear[4])
