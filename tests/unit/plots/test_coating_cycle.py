import numpy as np
import pytest

from bladerub.plots.coating_cycle import Cycle, coating_cycle

E, K = 2.0, 0.5


def cycle(yield_stress: float) -> Cycle:
    """Load to 0.03 and unload, in closed form."""
    strain = np.concatenate([np.linspace(0, 0.03, 31), np.linspace(0.029, 0, 30)])
    highest = np.maximum.accumulate(strain)
    plastic = np.maximum(E * highest - yield_stress, 0) / (E + K)
    stress = np.maximum(E * (strain - plastic), 0)
    return Cycle("(a)", strain, stress, plastic, E, K, yield_stress)


@pytest.fixture
def panels(draws):
    return draws(coating_cycle([cycle(0.0), cycle(0.02)])).axes


def test_slopes_and_elastic_limit_are_written(panels):
    texts = [text.get_text() for text in panels[1].texts]
    assert {"$E$ = 2", "$E_T$ = 0.4", r"$\sigma_Y$ = 0.02"} <= set(texts)
    assert any("too small to be seen" in text.get_text() for text in panels[0].texts)
    (limit,) = [line for line in panels[1].lines if line.get_label() == "_yield"]
    np.testing.assert_array_equal(limit.get_ydata(), 0.02)


def test_slope_triangles_have_the_slopes_they_name(panels):
    for panel in panels:
        triangles = [line.get_xydata() for line in panel.lines if line.get_label() == "_slope"]
        slopes = [(corner[1] - start[1]) / (corner[0] - start[0]) for start, _, corner in triangles]
        assert slopes == pytest.approx([2.0, 0.4])


def test_plastic_and_elastic_branches_are_told_apart(panels):
    elastic, plastic, *_ = panels[1].lines
    flowing = plastic.get_xydata()[~np.isnan(plastic.get_ydata())]
    np.testing.assert_allclose(np.diff(flowing[1:, 1]) / np.diff(flowing[1:, 0]), 0.4)
    unloading = elastic.get_xydata()[32:37]
    np.testing.assert_allclose(np.diff(unloading[:, 1]) / np.diff(unloading[:, 0]), 2.0)


def test_the_remaining_strain_is_marked_where_the_bar_comes_free(panels):
    for panel, yield_stress in zip(panels, (0.0, 0.02), strict=True):
        (mark,) = [line for line in panel.lines if line.get_marker() == "v"]
        assert mark.get_xdata() == pytest.approx([(E * 0.03 - yield_stress) / (E + K)])
