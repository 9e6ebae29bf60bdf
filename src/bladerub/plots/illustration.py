"""The tip of the blade on the abradable elements, and the stress–strain cycle of one of these."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from bladerub.contact.illustration import LoadingCycle, PressedElements
from bladerub.plots import titles
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, RED, new_figure, styled

_DRAWN_WIDTH = 0.86  # of an element, in widths
_ELEMENT_COLOUR = "#d5dbe3"
_LABEL = {"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.85}
_PLASTIC = {"color": DARK, "linewidth": 2.4, "solid_capstyle": "butt", "label": "plastic loading"}
_ELASTIC = {"color": ORANGE, "lw": 1.4, "ls": (0, (4, 1.5)), "label": "elastic: unloading, reloading"}
_REMAINS = r"plastic strain $\varepsilon^p$ that remains (wear)"
_REMAINING = {"color": BLUE, "marker": "v", "ms": 6, "ls": "none", "label": _REMAINS}


@styled
def tip_profile(scene: PressedElements) -> Figure:
    """Draw Fig. 3: the elements to scale (a) and their worn ends with the depth magnified (b)."""
    figure = new_figure(PAGE, 0.74 * PAGE)
    full_view, ends = figure.subplots(2, 1, sharex=True, height_ratios=[1.05, 1])
    _draw_whole(full_view, scene)
    _draw_ends(ends, scene)
    unit = titles.in_units(scene.coating.modulus_unit)
    full_view.set_title(f"(a) to scale: E = {scene.coating.E:g}, K = {scene.coating.K:g} ({unit})")
    ends.set_title("(b) the ends of the elements, depth magnified")
    return figure


def _outlines(scene: PressedElements) -> np.ndarray:
    """Corners (n, 4, 2), mm, of the elements between their worn or pressed ends and the casing."""
    lower, upper = scene.shortening, np.full_like(scene.shortening, scene.coating.thickness)
    lean, half = np.tan(scene.coating.theta), _DRAWN_WIDTH * scene.width / 2
    corners = [
        np.stack([scene.element * scene.width + side * half + lean * height, height], axis=-1)
        for side, height in ((-1, lower), (1, lower), (1, upper), (-1, upper))
    ]
    return 1e3 * np.stack(corners, axis=1)


def _draw_whole(axes: Axes, scene: PressedElements) -> None:
    thickness = 1e3 * scene.coating.thickness
    bottom, top = -0.45 * thickness, 1.18 * thickness
    x_min, x_max = 1e3 * (scene.element[[0, -1]] * scene.width + np.array([-1, 1.7]) * scene.width)
    colours = np.where(scene.shortening > scene.wear, ORANGE, _ELEMENT_COLOUR).tolist()
    look = {"facecolors": colours, "edgecolors": DARK, "linewidths": 0.5}
    axes.add_collection(PolyCollection(_outlines(scene), **look))
    axes.fill_between([x_min, x_max], thickness, top, facecolor=GREY, hatch="///", alpha=0.5, linewidth=0)
    middle, centred = ((x_min + x_max) / 2, (thickness + top) / 2), {"ha": "center", "va": "center"}
    axes.text(*middle, "rigid casing", bbox=_LABEL, **centred)
    x, y = 1e3 * (scene.tip_offset * scene.width), 1e3 * scene.tip_depth
    axes.fill_between(x, bottom, y, color=BLUE, alpha=0.35, linewidth=0)
    axes.plot(x, y, color=BLUE, linewidth=1.8, label="_tip")
    axes.text(0, 0.8 * bottom, "blade tip", color=DARK, **centred)
    _draw_angle(axes, scene)
    _draw_force(axes, scene)
    start, height = 1e3 * ((scene.tip_offset[-1] + 1) * scene.width), 0.55 * bottom
    end, arrow = start + 0.35 * (x_max - start), {"arrowstyle": "-|>", "color": DARK, "linewidth": 1.2}
    axes.annotate("", (end, height), (start, height), arrowprops=arrow)
    axes.text(end, height, r"  rotation, $e_\theta$", va="center")
    axes.set(xlim=(x_min, x_max), ylim=(bottom, top), aspect="equal", ylabel="height (mm)")


def _draw_angle(axes: Axes, scene: PressedElements) -> None:
    """Show θ between the radial direction and the first element."""
    theta = scene.coating.theta
    foot, length = 1e3 * (scene.element[0] * scene.width), 0.8e3 * scene.coating.thickness
    arc = np.linspace(0, theta, 20)
    axes.plot([foot, foot], [0, length], color=RED, linewidth=1.1, linestyle=":", label="_radial")
    axes.plot([foot, foot + length * np.sin(theta)], [0, length * np.cos(theta)], color=RED)
    axes.plot(foot + 0.9 * length * np.sin(arc), 0.9 * length * np.cos(arc), color=RED, linewidth=1.1)
    anchor, name = (foot + 0.45 * length, 0.4 * length), rf"$\theta$ = {theta:g} rad"
    axes.annotate(name, anchor, va="center", color=RED, bbox=_LABEL)


def _draw_force(axes: Axes, scene: PressedElements) -> None:
    """Mark the interface node and the direction of the force on it, which is that of the elements."""
    height, length = 1e3 * scene.tip_depth.max(), 0.27e3 * scene.coating.thickness
    end = (-length * np.sin(scene.coating.theta), height - length * np.cos(scene.coating.theta))
    axes.annotate("", end, (0, height), arrowprops={"arrowstyle": "-|>", "color": RED, "linewidth": 1.5})
    axes.annotate("$F^c$", end, xytext=(-4, 2), textcoords="offset points", color=RED, ha="right")
    axes.plot(0, height, marker="o", markersize=6, color=RED, linestyle="none", label="interface node")
    axes.legend(loc="lower left")


def _draw_ends(axes: Axes, scene: PressedElements) -> None:
    x, width = 1e3 * (scene.element * scene.width), 1e3 * _DRAWN_WIDTH * scene.width
    depth, wear = 1e6 * scene.shortening, 1e6 * scene.wear
    top = 1.45 * depth.max()
    line = {"edgecolor": DARK, "linewidth": 0.5}
    axes.bar(x, top - depth, width, depth, color=_ELEMENT_COLOUR, label="element", **line)
    axes.bar(x, depth - wear, width, wear, color=ORANGE, label="elastic shortening", **line)
    axes.bar(x, wear, width, color="white", hatch="////", label="permanent shortening: wear", **line)
    tip, tip_depth = 1e3 * (scene.tip_offset * scene.width), 1e6 * scene.tip_depth
    axes.plot(tip, tip_depth, color=BLUE, linewidth=2, label="blade tip", zorder=4)
    axes.plot(0, tip_depth.max(), marker="o", markersize=6, color=RED, zorder=5, label="_node")
    axes.axhline(0, color=DARK, linewidth=0.8, linestyle=(0, (4, 2)), label="original surface")
    axes.set(
        ylim=(-0.15 * depth.max(), top),
        xlabel="distance from the interface node along the circumference (mm)",
        ylabel="height over the\noriginal surface (µm)",
    )
    look = {"loc": "outside lower center", "ncols": 5, "handlelength": 1.4, "columnspacing": 1.0}
    axes.figure.legend(*axes.get_legend_handles_labels(), **look)


@styled
def coating_cycle(cycles: Mapping[str, LoadingCycle]) -> Figure:
    """Draw Fig. 4: a panel for each cycle by its title, with E, E_T, σ_Y and the remaining plastic strain."""
    figure = new_figure(PAGE, 0.5 * PAGE)
    panels = figure.subplots(1, len(cycles), sharex=True, squeeze=False)[0]
    for axes, (title, cycle) in zip(panels, cycles.items(), strict=True):
        _draw_cycle(axes, cycle)
        _mark_elastic_limit(axes, cycle)
        _mark_slopes(axes, cycle)
        axes.set(
            title=title,
            xlim=(0, 1.1 * cycle.strain.max()),
            ylim=(0, 1.12 * cycle.stress.max()),
            xlabel=r"compressive strain $\varepsilon$",
        )
    unit = next(iter(cycles.values())).coating.modulus_unit
    panels[0].set_ylabel(rf"compressive stress $\sigma$ ({titles.in_units(unit)})")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _draw_cycle(axes: Axes, cycle: LoadingCycle) -> None:
    stress = cycle.stress
    flows = np.append(np.diff(cycle.plastic_strain) > 0, False)
    flows |= np.roll(flows, 1)  # both ends of a flowing step
    axes.plot(cycle.strain, np.where((stress > 0) & ~flows, stress, np.nan), **_ELASTIC)
    axes.plot(cycle.strain, np.where(flows, stress, np.nan), **_PLASTIC)
    released = (stress[1:] == 0) & (stress[:-1] > 0)
    remaining = cycle.plastic_strain[1:][released]
    axes.plot(remaining, np.zeros(remaining.size), clip_on=False, zorder=4, **_REMAINING)


def _mark_elastic_limit(axes: Axes, cycle: LoadingCycle) -> None:
    limit = cycle.coating.yield_stress
    note = rf"$\sigma_Y$ = {limit:g}"
    if limit > 0.02 * cycle.stress.max():
        axes.axhline(limit, color=GREY, linestyle=":", linewidth=0.9, label="_yield")
        axes.text(1.09 * cycle.strain.max(), 0.98 * limit, note, ha="right", va="top")
    else:
        axes.text(0.02, 0.93, note + ": too small to be seen", transform=axes.transAxes)


def _mark_slopes(axes: Axes, cycle: LoadingCycle) -> None:
    """Draw a slope triangle under the last unloading, and one under the last loading."""
    E, K = cycle.coating.E, cycle.coating.K
    top = int(np.argmax(cycle.stress))
    strain, stress = cycle.strain[top], cycle.stress[top]
    for name, slope, share in (("E", E, 0.6), ("E_T", E * K / (E + K), 0.08)):
        height = min(0.22 * stress, 0.22 * slope * strain)
        length = height / slope
        # the upper corner lies on the branch, `share` of the stress below its end
        x, y = strain - share * stress / slope, stress * (1 - share)
        axes.plot([x - length, x, x], [y - height, y - height, y], color=GREY, linewidth=0.9, label="_slope")
        if name == "E":
            place = {"xy": (x, y - height / 2), "xytext": (3, 0), "ha": "left", "va": "center"}
        else:
            place = {"xy": (x - length / 2, y - height), "xytext": (0, -3), "ha": "center", "va": "top"}
        axes.annotate(f"${name}$ = {slope:g}", textcoords="offset points", **place)
