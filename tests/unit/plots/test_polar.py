import numpy as np
import pytest

from bladerub.plots.casing_polar import casing_polar
from bladerub.plots.polar import close
from bladerub.plots.wear_polar import wear_polar

ANGLE = np.linspace(0, 2 * np.pi, 60, endpoint=False)


def test_lines_close():
    angle, radius = close(ANGLE, np.cos(ANGLE))
    assert angle[-1] - angle[0] == pytest.approx(2 * np.pi)
    assert radius[-1] == radius[0]


def test_casing_is_magnified_inward(draws):
    inward = {"2": 1e-3 * np.cos(2 * ANGLE), "5": 1e-3 * np.cos(5 * ANGLE)}
    (axes,) = draws(casing_polar(ANGLE, inward, radius=0.65, magnification=100)).axes
    circle, two, five = axes.lines
    np.testing.assert_allclose(circle.get_ydata(), 0.65)
    np.testing.assert_allclose(two.get_ydata()[:-1], 0.65 - 0.1 * np.cos(2 * ANGLE))
    np.testing.assert_allclose(five.get_ydata()[:-1], 0.65 - 0.1 * np.cos(5 * ANGLE))
    assert len({str(line.get_linestyle()) + str(line.get_color()) for line in axes.lines}) == 3


def test_worn_depth_in_mm_on_one_scale_around_the_unworn_circle(draws):
    shallow, deep = 1e-4 * (1 + np.cos(2 * ANGLE)), 5e-4 * (1 + np.cos(6 * ANGLE))
    figure = draws(
        wear_polar(
            ANGLE,
            {"(a)": {"θ = 0": shallow, "θ = 0.15": deep}, "(b)": {"θ = 0": shallow, "θ = 0.15": shallow}},
        )
    )
    first, second = figure.axes
    np.testing.assert_allclose(first.lines[1].get_ydata()[:-1], 1e3 * deep)
    assert first.get_ylim() == second.get_ylim() == pytest.approx((0, 1.06))
    assert first.get_rorigin() < 0
    assert first.get_title(loc="left") == "(a)"
    assert "(mm)" in figure.legends[0].get_title().get_text()
