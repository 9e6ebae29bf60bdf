import numpy as np
import pytest
from matplotlib.colors import to_rgba

from bladerub.plots.style import ORANGE
from bladerub.plots.tip_profile import TipScene, tip_profile

SCENE = TipScene(
    element=np.arange(-3, 4) * 2e-3,
    shortening=np.array([80e-6, 80e-6, 90e-6, 100e-6, 90e-6, 0, 0]),
    wear=np.array([80e-6, 80e-6, 80e-6, 80e-6, 70e-6, 0, 0]),
    tip_position=np.linspace(-3e-3, 3e-3, 21),
    tip_depth=100e-6 - 20e-6 * np.linspace(-1, 1, 21) ** 2,
    width=2e-3,
    thickness=5e-3,
    theta=0.15,
)


@pytest.fixture
def panels(draws):
    return draws(tip_profile(SCENE, "E = 2")).axes


def test_bars_reach_from_the_surface_to_the_casing_at_their_angle(panels):
    bars = panels[0].collections[0]
    corners = np.array([path.vertices[:4] for path in bars.get_paths()])
    np.testing.assert_allclose(corners[:, 0, 1], 1e3 * SCENE.shortening, atol=1e-12)
    np.testing.assert_allclose(corners[:, 2, 1], 5.0)
    lean = corners[:, 3] - corners[:, 0]
    np.testing.assert_allclose(lean[:, 0] / lean[:, 1], np.tan(0.15))
    assert panels[0].get_aspect() == 1


def test_bars_that_push_stand_out(panels):
    pressed = [tuple(colour) == to_rgba(ORANGE) for colour in panels[0].collections[0].get_facecolors()]
    assert pressed == [False, False, True, True, True, False, False]


def test_worn_heights_in_micrometres(panels):
    element, elastic, worn = panels[1].containers
    np.testing.assert_allclose([bar.get_height() for bar in worn], 1e6 * SCENE.wear)
    np.testing.assert_allclose(
        [bar.get_height() for bar in elastic], 1e6 * (SCENE.shortening - SCENE.wear), atol=1e-9
    )
    np.testing.assert_allclose([bar.get_y() for bar in element], 1e6 * SCENE.shortening)
    assert "(µm)" in panels[1].get_ylabel()
    assert "(mm)" in panels[1].get_xlabel()


def test_angle_and_force_are_drawn(panels):
    texts = [text.get_text() for text in panels[0].texts]
    assert r"$\theta$ = 0.15 rad" in texts
    assert "$F^c$" in texts
    assert "rigid casing" in texts
