import numpy as np
import pytest

from bladerub.contact.illustration import LoadingCycle
from bladerub.contact.spec import Coating
from bladerub.plots.coating_cycle import coating_cycle

E, K = 2.0, 0.5


def cycle(yield_stress: float) -> LoadingCycle:
    """Load to 0.03 and unload, in closed form."""
    strain = np.concatenate([np.linspace(0, 0.03, 31), np.linspace(0.029, 0, 30)])
    highest = np.maximum.accumulate(strain)
    plastic = np.maximum(E * highest - yield_stress, 0) / (E + K)
    stress = np.maximum(E * (strain - plastic), 0)
    coating = Coating(E, K, 0.0, yield_stress, modulus_unit=1e8, thickness=5e-3, n_elements=2000)
    return LoadingCycle(coating, strain, stress, plastic)


@pytest.fixture
def panels(draws):
    return draws(coating_cycle({"(a) small": cycle(0.0), "(b) large": cycle(0.02)})).axes


def test_slope_triangles_have_the_slopes_they_name(panels):
    for panel in panels:
        triangles = [line.get_xydata() for line in panel.lines if line.get_label() == "_slope"]
        slopes = [(corner[1] - start[1]) / (corner[0] - start[0]) for start, _, corner in triangles]
        assert slopes == pytest.approx([2.0, 0.4])


def test_the_remaining_strain_is_marked_where_the_element_is_released(panels):
    for panel, yield_stress in zip(panels, (0.0, 0.02), strict=True):
        (mark,) = [line for line in panel.lines if line.get_marker() == "v"]
        assert mark.get_xdata() == pytest.approx([(E * 0.03 - yield_stress) / (E + K)])
