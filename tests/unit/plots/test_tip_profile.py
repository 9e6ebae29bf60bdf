import numpy as np
import pytest

from bladerub.contact.illustration import PressedElements
from bladerub.contact.spec import Coating
from bladerub.plots.tip_profile import tip_profile

SCENE = PressedElements(
    coating=Coating(2.0, 0.5, 0.15, yield_stress=0.0, modulus_unit=1e8, thickness=5e-3, n_elements=2000),
    width=2e-3,
    element=np.arange(-3, 4),
    shortening=np.array([80e-6, 80e-6, 90e-6, 100e-6, 90e-6, 0, 0]),
    wear=np.array([80e-6, 80e-6, 80e-6, 80e-6, 70e-6, 0, 0]),
    stress=np.zeros(7),
    tip_offset=np.linspace(-1.5, 1.5, 21),
    tip_depth=100e-6 - 20e-6 * np.linspace(-1, 1, 21) ** 2,
)


@pytest.fixture
def panels(draws):
    return draws(tip_profile(SCENE)).axes


def test_elements_reach_from_the_surface_to_the_casing_at_their_angle(panels):
    corners = np.array([path.vertices[:4] for path in panels[0].collections[0].get_paths()])
    np.testing.assert_allclose(corners[:, 0, 1], 1e3 * SCENE.shortening, atol=1e-12)
    np.testing.assert_allclose(corners[:, 2, 1], 5.0)
    lean = corners[:, 3] - corners[:, 0]
    np.testing.assert_allclose(lean[:, 0] / lean[:, 1], np.tan(0.15))
    at_surface = (corners[:, 0, 0] + corners[:, 1, 0]) / 2 - np.tan(0.15) * corners[:, 0, 1]
    np.testing.assert_allclose(at_surface, 2.0 * SCENE.element, atol=1e-9)
    assert panels[0].get_aspect() == 1


def test_worn_heights_in_micrometres(panels):
    element, elastic, worn = panels[1].containers
    np.testing.assert_allclose([bar.get_height() for bar in worn], 1e6 * SCENE.wear)
    np.testing.assert_allclose(
        [bar.get_height() for bar in elastic], 1e6 * (SCENE.shortening - SCENE.wear), atol=1e-9
    )
    np.testing.assert_allclose([bar.get_y() for bar in element], 1e6 * SCENE.shortening)
    np.testing.assert_allclose([bar.get_x() + bar.get_width() / 2 for bar in worn], 2.0 * SCENE.element)
