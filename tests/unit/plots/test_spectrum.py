import numpy as np
import pytest

from bladerub.plots.spectrum import ORDERS, PeakSection, peak_sections, spectrum_map
from bladerub.study.peaks import Peak

RANGE = (5e-7, 5e-4)
NO_BAND = (np.nan, np.nan)


@pytest.fixture
def axes(coating_map, draws):
    return draws(spectrum_map(coating_map, RANGE, f_max=2.5)).axes


def test_colours_are_the_amplitudes_in_mm_on_the_given_scale(axes, coating_map):
    mesh = axes[0].collections[0]
    drawn = mesh.get_array().reshape(6, -1)
    np.testing.assert_allclose(drawn[4], 1e3 * coating_map.spectrum_amplitude[4])
    assert (mesh.norm.vmin, mesh.norm.vmax) == pytest.approx((5e-4, 0.5))


def test_each_bin_lies_on_its_frequency(axes, coating_map):
    corners = axes[0].collections[0].get_coordinates()
    centres = (corners[1:, 1:] + corners[:-1, :-1]) / 2
    speed, order = 4, 8  # f_Ω = 0.3, eo(4)
    assert corners[speed, order, 0] < 4 * 0.3 < corners[speed + 1, order + 1, 0]
    assert centres[speed, order, 1] == pytest.approx(coating_map.f_omega[speed])


def test_c1_is_the_frequency_of_the_blade(axes, coating_map):
    (c1,) = [line for line in axes[0].lines if line.get_label() == "$C_1$"]
    np.testing.assert_array_equal(c1.get_xdata(), coating_map.C1)
    np.testing.assert_array_equal(c1.get_ydata(), coating_map.f_omega)
    assert c1.is_dashed()
    assert len(axes[0].lines) == len(ORDERS) + 1


@pytest.fixture
def sections(coating_map):
    on_order = coating_map.spectrum_amplitude[:, 8]
    return [
        PeakSection(4, on_order, (0.25, 0.36), Peak(0.3, on_order[4]), (0.29, 0.31), (1e-5, 2e-5)),
        PeakSection(
            6, coating_map.spectrum_amplitude[:, 12], (0.16, 0.24), Peak(0.2, 1e-6), NO_BAND, NO_BAND
        ),
    ]


@pytest.fixture
def peak_axes(coating_map, sections, draws):
    return draws(peak_sections(coating_map, sections, RANGE, f_max=2.5)).axes


def test_a_peak_with_an_ensemble_has_error_bars(peak_axes):
    bars = {line.get_label(): [] for line in peak_axes[1].lines if line.get_label().startswith("_band")}
    for line in peak_axes[1].lines:
        if line.get_label() in bars:
            bars[line.get_label()].append(np.transpose(line.get_data()).tolist())
    (across, along) = bars.pop("_band4")
    assert not bars
    np.testing.assert_allclose(across, [[0.01, 0.3], [0.02, 0.3]])
    assert [f for _, f in along] == [0.29, 0.31]


def test_curves_are_the_amplitudes_in_mm(peak_axes, sections):
    curves = [line for line in peak_axes[1].lines if line.get_label().startswith("eo(")]
    assert len(curves) == 2
    for curve, section in zip(curves, sections, strict=True):
        np.testing.assert_allclose(curve.get_xdata(), 1e3 * section.amplitude)
    assert peak_axes[1].get_xlim() == pytest.approx((0, 1.1 * 0.101))
