"""What figures of a blade from another program say besides the normalised numbers."""

import numpy as np
import pytest

from bladerub.plots.campbell import campbell
from bladerub.plots.scales import Engine, Scales
from bladerub.plots.wear_map import wear_map

ENGINE = Engine(f1_hz=850.0, nominal_speed=15300.0)  # f_omega = 0.3
SCALES = Scales(modulus_unit=0.6e9, length=0.066, engine=ENGINE)


def second(axes, along):
    """Limits, name and numbers of the second scale along "x" or "y"."""
    axes.figure.canvas.draw()
    (found,) = [child for child in axes.child_axes if getattr(child, f"get_{along}label")()]
    ends = getattr(found, f"get_{along}lim")()
    ticks = [text.get_text() for text in getattr(found, f"get_{along}ticklabels")()]
    return ends, getattr(found, f"get_{along}label")(), ticks


def nominal(axes):
    """Where the lines of the nominal speed are, by their label."""
    return {line.get_label(): line.get_xydata()[0] for line in axes.lines if "nominal" in line.get_label()}


def test_a_wear_map_has_the_speed_of_the_rotor_from_the_first_of_the_study_on(coating_map, draws):
    upper, lower, _ = draws(wear_map(coating_map, SCALES)).axes
    assert lower.get_xlim() == pytest.approx((0.075, 0.375))
    ends, name, ticks = second(lower, "x")
    assert ends == pytest.approx(60 * 850 * np.array([0.075, 0.375]))
    assert name == "rotor speed (rpm, Hz)"
    assert "12000\n200 Hz" in ticks
    assert nominal(upper)["nominal speed, 15300 rpm"][0] == pytest.approx(0.3)
    assert nominal(lower)["_nominal"][0] == pytest.approx(0.3)


def test_a_campbell_diagram_has_both(draws):
    speed = np.linspace(0, 0.4, 5)
    modes = np.sqrt(np.array([1, 9, 25])[None] + 4 * speed[:, None] ** 2)
    for axes in draws(campbell(speed, modes, modes, range(1, 13), ENGINE)).axes:
        assert second(axes, "x")[0] == pytest.approx((0, 20400))
        assert second(axes, "y")[0] == pytest.approx(850 * np.array(axes.get_ylim()))
        assert nominal(axes)["nominal speed, 15300 rpm"][0] == pytest.approx(0.3)
