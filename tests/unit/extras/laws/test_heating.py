import numpy as np
import pytest

from bladerub.contact.kernel.records import at_rest
from bladerub.contact.laws import module_of
from bladerub.contact.spec import Coating
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.extras.laws.heating import CELLS, HEATED, Layer, cell_heights

THICKNESS, AREA, PERIOD = 5e-3, np.linspace(1e-6, 2e-6, 8), 0.02
N = 12
VALUES = LAYER | {"softening_exponent": 2.0}


def layer(**values):
    law = described_law("thermal", VALUES | values)
    coating = Coating(1.1, 0.5, 0.1, 1e-6, 600e6, THICKNESS, N, element_law=law)
    return Layer(module_of(law), coating, AREA, PERIOD)


def heated(flow=0.0, friction=0.0):
    """State after a passage that made so much heat in rows 3 to 5, J."""
    state = at_rest(1, N, kept=CELLS)
    state.taken[3:6] = np.repeat([flow, friction], 8)
    return state


def test_cells_fill_the_layer_from_the_heated_depth_on():
    height = cell_heights(THICKNESS, 1e-4)
    assert height.size == CELLS
    assert height[:HEATED].sum() == pytest.approx(1e-4)
    assert height.sum() == pytest.approx(THICKNESS)
    ratio = height[1:] / height[:-1]
    np.testing.assert_allclose(ratio[: HEATED - 1], 1)
    np.testing.assert_allclose(ratio[HEATED - 1 :], ratio[-1])
    assert ratio[-1] > 1


def test_without_conduction_all_heat_stays_in_the_heated_depth_and_cells_are_in_series():
    own, state = layer(conductivity=0.0), heated(flow=0.01, friction=0.03)
    own.rest(state, 0, N)
    rise = own.temperature(state)
    wanted = (0.01 + 0.5 * 0.03) / AREA / (2e6 * 1e-4)
    np.testing.assert_allclose(own.rise(state)[3:6], np.broadcast_to(wanted, (3, 8)), rtol=1e-10)
    np.testing.assert_allclose(np.ptp(rise[..., :HEATED], axis=-1), 0, atol=1e-9)
    np.testing.assert_allclose(rise[..., HEATED:], 0, atol=1e-9)
    assert not rise[:3].any()
    assert not state.taken.any()
    left = np.maximum(1 - (wanted / 500) ** 2, 0.01)
    strength = 1 / ((1 - 1e-4 / THICKNESS) + 1e-4 / THICKNESS / left)
    np.testing.assert_allclose(state.strength[4], strength, rtol=1e-9)
    np.testing.assert_array_equal(state.strength[8], 1.0)


def test_rows_wrap_around_and_others_wait_and_two_shorter_rests_are_one():
    own, state = layer(), heated(flow=0.01)
    own.rest(state, -8, -7)  # row 4
    assert not state.taken[4].any()
    assert state.taken[[3, 5], :8].all()
    assert (state.strength[4] < 1).all()
    assert (state.strength[[3, 5]] == 1).all()
    once, twice = heated(flow=0.01), heated(flow=0.01)
    own = layer()
    own.rest(once, 0, N, 0.7)
    own.rest(twice, 0, N, 0.3)
    own.rest(twice, 0, N, 0.4)
    np.testing.assert_allclose(own.temperature(twice), own.temperature(once), atol=1e-9)
    strength = own.law.strength(own.coating, np.array([[0.0], [250.0], [1e4]]))
    np.testing.assert_allclose(strength.ravel(), [1.0, 0.75, 0.01])
