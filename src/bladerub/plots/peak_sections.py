"""Spectrum with its maxima along engine orders, and the amplitude along those engine orders beside it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.plots import titles
from bladerub.plots.spectrum_map import add_amplitude_bar, draw_spectrum
from bladerub.plots.style import DARK, ORANGE, PAGE, RED, new_figure, styled
from bladerub.study.maps import CoatingMap

_LOOKS = (
    {"color": DARK, "linestyle": "-", "marker": "o"},
    {"color": ORANGE, "linestyle": "--", "marker": "s"},
)
_RING = {"marker": "o", "fillstyle": "none", "zorder": 4, "linestyle": "none"}


@dataclass(frozen=True)
class PeakSection:
    """Amplitude along one engine order, and its maximum.

    Parameters
    ----------
    order : int
        The engine order k.
    amplitude : (n,) ndarray
        Amplitude on eo(k) at each speed, m.
    window : (float, float)
        Speeds between which the maximum was searched, normalised.
    f_peak, peak : float
        Speed f_k (normalised) and amplitude Y_k (m) of the maximum.
    """

    order: int
    amplitude: np.ndarray
    window: tuple[float, float]
    f_peak: float
    peak: float


@styled
def peak_sections(
    coating: CoatingMap, sections: list[PeakSection], amplitude_range: tuple[float, float], f_max: float
) -> Figure:
    """Draw Fig. 10: the spectrum with Y_k marked (a), the amplitude along eo(k) with its window (b).

    Parameters
    ----------
    coating, amplitude_range, f_max
        As in `spectrum_map.spectrum_map`.
    sections : list of PeakSection
        One or two.
    """
    figure = new_figure(PAGE, 0.66 * PAGE)
    spectrum, curves = figure.subplots(1, 2, sharey=True, width_ratios=[1.5, 1])
    mesh = draw_spectrum(spectrum, coating, amplitude_range, f_max)
    spectrum.set_title("(a) " + titles.coating(coating.case), pad=16)
    add_amplitude_bar(figure, spectrum, mesh, location="bottom", aspect=40)
    end = 1e3 * max(np.nanmax(section.amplitude) for section in sections)
    for section, look in zip(sections, _LOOKS, strict=False):
        ray = coating.f_omega[-1] * np.array([0, 1])
        spectrum.plot(section.order * ray, ray, color=RED, linewidth=0.8, label="_section")
        _draw_ring(spectrum, section.order * section.f_peak, section.f_peak)
        _draw_section(curves, coating.f_omega, section, look)
    curves.set_title("(b) along the engine orders", pad=16)
    curves.set(xlim=(0, 1.1 * end), xlabel="amplitude (mm)")
    curves.tick_params(labelleft=True)
    legend = curves.legend(
        loc="upper center", bbox_to_anchor=(0.45, -0.11), title="shaded: searched speeds", title_fontsize=7
    )
    legend.set_in_layout(False)  # it stands in the room that the colour bar makes
    return figure


def _draw_section(axes: Axes, f_omega: np.ndarray, section: PeakSection, look: dict) -> None:
    k, peak = section.order, 1e3 * section.peak
    label = f"eo({k}): $Y_{{{k}}}$ = {peak:.3g} mm at $f_{{{k}}}$ = {section.f_peak:.3f}"
    axes.axhspan(*section.window, color=look["color"], alpha=0.13, linewidth=0, label=f"_window{k}")
    axes.plot(1e3 * section.amplitude, f_omega, markersize=2.2, linewidth=1.0, label=label, **look)
    _draw_ring(axes, peak, section.f_peak)


def _draw_ring(axes: Axes, x: float, y: float) -> None:
    axes.plot(x, y, color="white", markersize=10, markeredgewidth=3, label="_halo", **_RING)
    axes.plot(x, y, color=RED, markersize=10, markeredgewidth=1.4, label="_peak", **_RING)
