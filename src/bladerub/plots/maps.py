"""Maps over the speed: wear around the casing and spectrum of the blade, each line one simulation.

A bin of a map reaches half-way to the neighbouring speeds; where nothing was simulated it is empty.
"""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots import style, titles
from bladerub.plots.scales import LARGE, ORDERS, UNKNOWN, Scales, draw_engine_orders, greatest
from bladerub.plots.style import DARK, PAGE, RED, new_figure
from bladerub.settings.analysis import Peaks
from bladerub.study.maps import CoatingMap
from bladerub.study.peaks import order_amplitude, peak, speed_window

if TYPE_CHECKING:
    import pandas as pd

_COMPLETED = {"marker": "o", "markersize": 2.5, "color": DARK, "label": "completed"}
_ENDED_EARLY = {"marker": "x", "markersize": 4, "color": RED, "label": "ended early"}
_RINGED = {"marker": "o", "markersize": 6, "fillstyle": "none", "color": RED, "label": LARGE}
_LARGE = {"marker": ">", "color": RED, "markersize": 4, "linestyle": "none", "clip_on": False, "label": LARGE}
_RING = {"marker": "o", "fillstyle": "none", "zorder": 4, "linestyle": "none"}
_LOOKS = (style.FIRST | {"marker": "o"}, style.SECOND | {"marker": "s"})


def edges(centres: np.ndarray) -> np.ndarray:
    """Edges (n + 1,) of the bins around `centres` (n,), half-way between; `ValueError` unless they ascend."""
    centres = np.asarray(centres, dtype=float)
    if centres.size < 2 or np.any(np.diff(centres) <= 0):
        raise ValueError(f"bins need two or more ascending centres, not {centres}")
    middle = (centres[1:] + centres[:-1]) / 2
    return np.concatenate([[2 * centres[0] - middle[0]], middle, [2 * centres[-1] - middle[-1]]])


def with_gaps(f_omega: np.ndarray, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Bins around the simulated speeds (n,), with an empty row wherever speeds are missing.

    A bin reaches to the middle between neighbours, but no further than the usual speed step: a long stretch
    without a simulation stays a gap. Returns the edges of m ≥ n bins, and `values` (n, ...) with NaN in gaps.
    """
    f_omega, values = np.asarray(f_omega, dtype=float), np.asarray(values, dtype=float)
    middle = edges(f_omega)
    reach = np.median(np.diff(f_omega))
    lower, upper = np.maximum(middle[:-1], f_omega - reach), np.minimum(middle[1:], f_omega + reach)
    gaps = np.flatnonzero(lower[1:] > upper[:-1]) + 1
    return np.union1d(lower, upper), np.insert(values, gaps, np.nan, axis=0)


@style.on_axes
def wear_map(coating: CoatingMap, scales: Scales = UNKNOWN, ax: Axes | None = None) -> Figure:
    """Draw Fig. 6: worn depth over speed and casing angle, below it the number of worn lobes.

    Runs that exceeded the displacement limit are crossed below: their wear is that of their early end. Those
    with a displacement beyond small ones are ringed. Axes that are given hold the upper diagram.
    """
    upper = lower = ax
    if ax is None:
        figure = new_figure(PAGE, 0.68 * PAGE)
        upper, lower = figure.subplots(2, 1, sharex=True, height_ratios=[4, 1])
        _draw_lobes(lower, coating, scales)
        handles, labels = lower.get_legend_handles_labels()
        if len(handles) > 1:
            figure.legend(handles, labels, loc="outside lower center", ncols=4, handletextpad=0.4)
    _draw_wear(upper, coating, scales)
    lower.set_xlabel(r"rotational frequency $f_\Omega\,/\,f_1(0)$")
    scales.add_speeds(lower, "x")
    return upper.figure


def _draw_wear(axes: Axes, coating: CoatingMap, scales: Scales) -> None:
    speed_edges, rows = with_gaps(coating.f_omega, 1e3 * coating.wear)
    angle_edges, look = np.degrees(edges(coating.angle)), {"cmap": style.WEAR_MAP, "vmin": 0}
    mesh = axes.pcolormesh(speed_edges, angle_edges, np.ma.masked_invalid(rows.T), **look, rasterized=True)
    axes.figure.colorbar(mesh, ax=axes, label="worn depth, mean of the nodes (mm)", pad=0.015)
    start = speed_edges[0] if scales.f1_hz else 0.0
    axes.set(facecolor=style.MISSING, ylim=(0, 360), yticks=range(0, 361, 60), ylabel="casing angle (°)")
    axes.set(xlim=(start, speed_edges[-1]))
    axes.set_title(titles.coating(coating.case, scales.modulus_unit), loc="left")
    if start < speed_edges[0] or not np.isfinite(rows).all():
        axes.set_title("grey: not computed", loc="right", fontsize=7)
    scales.draw_nominal_speed(axes.axvline)


def _draw_lobes(axes: Axes, coating: CoatingMap, scales: Scales) -> None:
    completed = coating.status == "completed"
    large = completed & scales.is_large(coating)
    for runs, look in ((completed, _COMPLETED), (~completed, _ENDED_EARLY), (large, _RINGED)):
        if runs.any():
            axes.plot(coating.f_omega[runs], coating.lobes[runs], linestyle="none", **look)
    axes.yaxis.set_major_locator(MaxNLocator(integer=True, nbins=5))
    axes.grid(axis="y")
    axes.set(ylim=(0, 1.2 * max(1, coating.lobes.max())), ylabel="worn lobes")
    scales.draw_nominal_speed(axes.axvline)


@style.on_axes
def spectrum_map(
    coating: CoatingMap,
    amplitude_range: tuple[float, float],
    f_max: float,
    scales: Scales = UNKNOWN,
    ax: Axes | None = None,
) -> Figure:
    """Draw Figs. 7, 8, 9, 15 and 16: f horizontally, f_Ω vertically, amplitude in colour.

    `amplitude_range` are the ends of the logarithmic colours, m, `f_max` that of the frequencies, normalised.
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
    speed_edges, rows = with_gaps(coating.f_omega, 1e3 * coating.spectrum_amplitude)
    order_edges = np.maximum(edges(coating.spectrum_order), 0)
    frequencies, speeds = np.broadcast_arrays(np.outer(speed_edges, order_edges), speed_edges[:, None])
    look = {"cmap": style.AMPLITUDE_MAP, "norm": LogNorm(*(1e3 * end for end in amplitude_range))}
    mesh = axes.pcolormesh(frequencies, speeds, np.ma.masked_invalid(rows), **look, rasterized=True)
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
