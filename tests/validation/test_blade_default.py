"""The default blade lies in the window of the paper, and its reduced model is as accurate as the paper's."""

import numpy as np
import pytest

from bladerub.blade.frequencies import tip_lean
from bladerub.extras.blades.similarity import contact_scale

pytestmark = pytest.mark.slow


def test_first_frequency_and_how_speed_stiffens_it(built):
    # Crossings of C1 with eo(4) and eo(6) below the paper's peaks at 0.31 and 0.21 depend on it.
    assert built.reduced.f1_hz == pytest.approx(192.2, abs=0.3)
    first = built.accuracy[built.accuracy["mode"] == 1].set_index("f_omega").f_fe
    assert first[0.4] / first[0.0] == pytest.approx(1.305, abs=0.005)


def test_bending_with_the_rotation_moves_the_tip_inward(built):
    shape = built.mode_shape[0][built.mesh.interface]
    radial = np.sum(shape * built.reduced.radial_direction, axis=1)
    tangential = np.sum(shape * built.reduced.tangential_direction, axis=1)
    assert radial @ tangential / (tangential @ tangential) == pytest.approx(-0.21, abs=0.02)
    lean = tip_lean(built.reduced)
    print("u_r/u_t from leading to trailing edge:", lean)
    assert np.all(np.diff(lean) > 0)
    assert (lean[0], lean[-1]) == pytest.approx((-0.286, -0.153), abs=0.005)


def test_seven_modes_of_a_model_of_the_papers_size_follow_the_finite_elements(built):
    assert 80 <= len(built.reduced.mass) <= 90  # the paper has 85
    error = built.accuracy.relative_error.abs().groupby(built.accuracy["mode"]).max()
    print("largest error of the reduced model by mode:", error.to_dict())
    assert error[:6].max() <= 0.005
    assert error[7] <= 0.02


def test_speed_law_interpolates_the_stiffness(built):
    """Eq. (2) is exact at rest, at half and at full speed, and off by 0.15 % at most between."""
    table = built.accuracy[built.accuracy["mode"] <= 7]
    error = (table.f_fe_eq2 / table.f_fe - 1).abs().groupby(table.f_omega).max()
    print("largest error of eq. (2) at each speed:", error.to_dict())
    assert error[[0.0, 0.2, 0.4]].max() < 1e-9
    assert error.max() < 1.5e-3


def test_other_blades_are_put_in_proportion_to_it_which_the_rotation_hardly_bends(built):
    assert contact_scale(built.reduced) == pytest.approx({"length": 1, "modulus": 1, "time": 1}, rel=1e-8)
    assert np.linalg.norm(built.static_displacement[-1], axis=1).max() < 0.5e-3
