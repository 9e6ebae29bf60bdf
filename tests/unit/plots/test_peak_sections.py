import numpy as np
import pytest

from bladerub.plots.peak_sections import PeakSection, peak_sections


@pytest.fixture
def sections(coating_map):
    on_order = coating_map.spectrum_amplitude[:, 8]
    return [
        PeakSection(4, on_order, (0.25, 0.36), 0.3, on_order[4]),
        PeakSection(6, coating_map.spectrum_amplitude[:, 12], (0.16, 0.24), 0.2, 1e-6),
    ]


@pytest.fixture
def axes(coating_map, sections, draws):
    return draws(peak_sections(coating_map, sections, (5e-7, 5e-4), f_max=2.5)).axes


def test_curves_are_the_amplitudes_in_mm(axes, sections):
    curves = [line for line in axes[1].lines if line.get_label().startswith("eo(")]
    assert len(curves) == 2
    for curve, section in zip(curves, sections, strict=True):
        np.testing.assert_allclose(curve.get_xdata(), 1e3 * section.amplitude)
    assert axes[1].get_xlabel() == "amplitude (mm)"


def test_the_legend_tells_height_and_speed(axes):
    texts = [text.get_text() for text in axes[1].get_legend().get_texts()]
    assert texts[0] == "eo(4): $Y_{4}$ = 0.101 mm at $f_{4}$ = 0.300"


def test_maxima_are_ringed_in_both_panels(axes):
    on_spectrum = [line.get_xydata()[0] for line in axes[0].lines if line.get_label() == "_peak"]
    on_curves = [line.get_xydata()[0] for line in axes[1].lines if line.get_label() == "_peak"]
    np.testing.assert_allclose(on_spectrum, [[4 * 0.3, 0.3], [6 * 0.2, 0.2]])
    np.testing.assert_allclose(on_curves, [[0.101, 0.3], [1e-3, 0.2]])


def test_the_searched_speeds_are_shaded(axes, sections):
    bands = [patch.get_extents().transformed(axes[1].transData.inverted()) for patch in axes[1].patches]
    for band, section in zip(bands, sections, strict=True):
        assert (band.y0, band.y1) == pytest.approx(section.window)
