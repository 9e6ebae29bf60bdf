import numpy as np
import pytest

from bladerub.contact.spec import TipProfile
from bladerub.contact.tip import coverage, highest, relief

TIP = TipProfile(half_width=2.0, edge_drop=20e-6)


def test_profile_is_a_parabola_with_the_given_edge():
    np.testing.assert_allclose(relief(TIP, np.array([0.0, 1.0, 2.0, -2.0])), [0, 5e-6, 20e-6, 20e-6])


@pytest.mark.parametrize("position", [0.0, 0.2, 0.5, 0.77])
def test_elements_under_the_tip_add_up_to_its_width_wherever_it_stands(position):
    offset = np.arange(-6, 7) + 0.5 - position
    assert coverage(TIP, offset).sum() == pytest.approx(2 * TIP.half_width)


def test_coverage_fades_over_the_width_of_one_element():
    np.testing.assert_allclose(coverage(TIP, np.array([1.5, 2.0, 2.25, 2.5, 3.0])), [1, 0.5, 0.25, 0, 0])


@pytest.mark.parametrize("tilt", [1e-9, 3e-6, 19e-6, 40e-6])
@pytest.mark.parametrize("edge_drop", [0.0, 20e-6])
def test_highest_point_of_a_tilted_profile_is_that_of_a_search(tilt, edge_drop):
    tip = TipProfile(half_width=2.0, edge_drop=edge_drop)
    offset = np.linspace(-2.5, 2.5, 20_001)
    with np.errstate(divide="ignore"):  # a flat profile is highest at its edge
        found = highest(tip, np.array(tilt))
    assert found == pytest.approx(np.max(tilt * offset - relief(tip, offset)), rel=1e-6, abs=1e-13)


def test_rolling_tip_touches_where_a_circle_of_its_curvature_does():
    """A circle of radius R that rolls by ψ about its lowest point comes ψ² R / 2 closer."""
    width, radius, angle = 2e-3, 0.4, 5e-3  # m, m, rad
    tip = TipProfile(half_width=2.0, edge_drop=(2.0 * width) ** 2 / (2 * radius))
    assert highest(tip, np.array(angle * width)) == pytest.approx(angle**2 * radius / 2)
