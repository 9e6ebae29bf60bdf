import numpy as np
import pytest

from bladerub.contact.spec import TipProfile
from bladerub.contact.tip import coverage, relief

TIP = TipProfile(half_width=2.0, edge_drop=20e-6)


def test_profile_is_a_parabola_with_the_given_edge():
    np.testing.assert_allclose(relief(TIP, np.array([0.0, 1.0, 2.0, -2.0])), [0, 5e-6, 20e-6, 20e-6])


@pytest.mark.parametrize("position", [0.0, 0.2, 0.5, 0.77])
def test_elements_under_the_tip_add_up_to_its_width_wherever_it_stands(position):
    offset = np.arange(-6, 7) + 0.5 - position
    assert coverage(TIP, offset).sum() == pytest.approx(2 * TIP.half_width)


def test_coverage_fades_over_the_width_of_one_element():
    np.testing.assert_allclose(coverage(TIP, np.array([1.5, 2.0, 2.25, 2.5, 3.0])), [1, 0.5, 0.25, 0, 0])
