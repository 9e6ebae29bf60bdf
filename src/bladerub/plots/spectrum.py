"""Spectrum of the blade over frequency and speed, with the engine orders, C1 and the peaks."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure

from bladerub.plots import bins, style, titles
from bladerub.plots.scales import LARGE, ORDERS, UNKNOWN, Scales, draw_engine_orders, greatest
from bladerub.plots.style import PAGE, RED, new_figure
from bladerub.settings.analysis import Peaks
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import order_amplitude, peak, speed_window

if TYPE_CHECKING:
    import pandas as pd

_LOOKS = (style.FIRST | {"marker": "o"}, style.SECOND | {"marker": "s"})
_LARGE = {"marker": ">", "color": RED, "markersize": 4, "linestyle": "none", "clip_on": False, "label": LARGE}
_RING = {"marker": "o", "fillstyle": "none", "zorder": 4, "linestyle": "none"}


@style.on_axes
def spectrum_map(
    coating: CoatingMap,
    amplitude_range: tuple[float, float],
    f_max: float,
    scales: Scales = UNKNOWN,
    ax: Axes | None = None,
) -> Figure:
    """Draw Figs. 7, 8, 9, 15 and 16: f horizontally, f_Ω vertically, amplitude in colour.

    `amplitude_range` are the ends of the logarithmic colour scale, m, `f_max` is that of the frequency axis,
    normalised.
    """
    axes = ax or new_figure(PAGE, 0.62 * PAGE).add_subplot()
    _draw_spectrum(axes, coating, amplitude_range, f_max, scales)
    if ax is None:
        _add_legend(axes, scales)
    else:
        axes.legend(loc="lower right")
    return axes.figure


@style.styled
def peak_sections(
    coating: CoatingMap,
    settings: Peaks,
    amplitude_range: tuple[float, float],
    f_max: float,
    scales: Scales = UNKNOWN,
) -> "tuple[pd.DataFrame, Figure]":
    """Draw Fig. 10: the spectrum with Y_k marked (a), the amplitude along eo(k) with its window (b).

    The first two orders of the `settings`, ``config.analysis.peaks``, are drawn; the other arguments are as
    of `spectrum_map`. The table is what is drawn in (b): ``order``, ``f_omega`` and ``amplitude``, m.
    """
    import pandas as pd  # spectra do without

    figure = new_figure(PAGE, 0.7 * PAGE)
    spectrum, curves = figure.subplots(1, 2, sharey=True, width_ratios=[1.5, 1])
    _draw_spectrum(spectrum, coating, amplitude_range, f_max, scales, location="bottom", aspect=40)
    figure.suptitle(titles.coating(coating.case, scales.modulus_unit), fontsize="medium")
    spectrum.set_title("(a) over frequency and speed", pad=16)
    _add_legend(spectrum, scales)
    ray = coating.f_omega[-1] * np.array([0, 1])
    sections = []
    for k, look in zip(settings.orders, _LOOKS, strict=False):
        amplitude = order_amplitude(coating, k, settings.order_halfwidth)
        sections.append(pd.DataFrame({"order": k, "f_omega": coating.f_omega, "amplitude": amplitude}))
        f_peak, height, reason = peak(coating, k, settings)
        spectrum.plot(k * ray, ray, color=RED, linewidth=0.8, label="_section")
        _draw_ring(spectrum, k * f_peak, f_peak)
        label = f"eo({k}): $Y_{{{k}}}$ = {1e3 * height:.3g} mm at $f_{{{k}}}$ = {f_peak:.3f}"
        window = speed_window(coating, k, settings)
        if np.isfinite(window).all():
            curves.axhspan(*window, color=look["color"], alpha=0.13, linewidth=0, label=f"_window{k}")
        look = look | {"label": f"eo({k}): no peak" if reason else label}
        curves.plot(1e3 * amplitude, coating.f_omega, markersize=2.2, linewidth=1.0, **look)
        _draw_ring(curves, 1e3 * height, f_peak)
    table = pd.concat(sections)
    curves.set_title("(b) along the engine orders", pad=16)
    end = 1e3 * greatest(table.amplitude)
    curves.set(xlim=(0, 1.1 * end), xlabel="amplitude (mm)")
    curves.tick_params(labelleft=True)
    legend = curves.legend(
        loc="upper center", bbox_to_anchor=(0.45, -0.13), title="shaded: searched speeds", title_fontsize=7
    )
    legend.set_in_layout(False)  # it is in the room that the colour bar makes
    return table, figure


def _draw_spectrum(
    axes: Axes, coating: CoatingMap, amplitude_range: tuple, f_max: float, scales: Scales, **colour_bar
) -> None:
    speed_edges, rows = bins.with_gaps(coating.f_omega, 1e3 * coating.spectrum_amplitude)
    order_edges = np.maximum(bins.edges(coating.spectrum_order), 0)
    frequency_edges, edges = np.broadcast_arrays(np.outer(speed_edges, order_edges), speed_edges[:, None])
    look = {"cmap": style.AMPLITUDE_MAP, "norm": LogNorm(*(1e3 * end for end in amplitude_range))}
    mesh = axes.pcolormesh(frequency_edges, edges, np.ma.masked_invalid(rows), **look, rasterized=True)
    speed_max = float(speed_edges[-1])
    draw_engine_orders(axes, {k: 1 / k for k in ORDERS}, f_max, speed_max)
    dashed = {"color": style.BLUE, "linestyle": (0, (5, 2)), "linewidth": 1.4}
    axes.plot(coating.C1, coating.f_omega, label="$C_1$", zorder=3, **dashed)
    large = coating.f_omega[scales.is_large(coating)]
    if large.size:
        axes.plot(np.zeros(large.size), large, **_LARGE)
    scales.draw_nominal_speed(axes.axhline)
    scales.add_speeds(axes, "y")
    scales.add_frequencies(axes, "x")
    axes.set(
        facecolor=style.MISSING,
        xlim=(0, f_max),
        ylim=(speed_edges[0] if scales.f1_hz else 0.0, speed_max),
        xlabel=r"frequency $f\,/\,f_1(0)$",
        ylabel=r"rotational frequency $f_\Omega\,/\,f_1(0)$",
    )
    axes.set_title(titles.coating(coating.case, scales.modulus_unit), pad=16)
    label = "amplitude of node 1, radial (mm, log scale)"
    axes.figure.colorbar(mesh, ax=axes, label=label, extend="both", pad=0.015, **colour_bar)


def _add_legend(axes: Axes, scales: Scales) -> None:
    if scales.f1_hz:  # without the empty room below the first speed
        handles = axes.get_legend_handles_labels()
        axes.figure.legend(*handles, loc="outside lower center", ncols=4)
    else:
        axes.legend(loc="lower right", title="grey: not computed", title_fontsize=7)


def _draw_ring(axes: Axes, x: float, y: float) -> None:
    axes.plot(x, y, color="white", markersize=10, markeredgewidth=3, label="_halo", **_RING)
    axes.plot(x, y, color=RED, markersize=10, markeredgewidth=1.4, label="_peak", **_RING)
