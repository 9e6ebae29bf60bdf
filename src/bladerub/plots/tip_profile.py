"""Tip of the blade under one interface node, and the coating elements it presses on."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PolyCollection
from matplotlib.figure import Figure

from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, RED, new_figure, styled

_BAR = 0.86  # drawn width of a bar, in elements
_BAR_COLOUR = "#d5dbe3"
_LABEL = {"facecolor": "white", "edgecolor": "none", "pad": 1.5, "alpha": 0.85}


@dataclass(frozen=True)
class TipScene:
    """The tip in the coating at one instant.

    Parameters
    ----------
    element : (n,) ndarray
        Position of the elements' centres along the circumference, m.
    shortening : (n,) ndarray
        How far each bar is shortened at this instant, m.
    wear : (n,) ndarray
        Permanent part of it, m; what is above it is elastic, and the bar pushes on the tip.
    tip_position, tip_depth : (m,) ndarray
        Profile of the tip and its depth below the original surface, m.
    width, thickness : float
        Of an element, m.
    theta : float
        Rotation of the elements, rad.
    """

    element: np.ndarray
    shortening: np.ndarray
    wear: np.ndarray
    tip_position: np.ndarray
    tip_depth: np.ndarray
    width: float
    thickness: float
    theta: float


@styled
def tip_profile(scene: TipScene, title: str) -> Figure:
    """Draw Fig. 3: the elements to scale (a) and their worn ends with the depth magnified (b)."""
    figure = new_figure(PAGE, 0.74 * PAGE)
    whole, ends = figure.subplots(2, 1, sharex=True, height_ratios=[1.05, 1])
    _draw_whole(whole, scene)
    _draw_ends(ends, scene)
    whole.set_title("(a) to scale: " + title)
    ends.set_title("(b) the ends of the elements, depth magnified")
    return figure


def _bars(scene: TipScene, lower: np.ndarray, upper: np.ndarray) -> np.ndarray:
    """Corners (n, 4, 2), mm, of the bars between two heights above the original surface."""
    lean = np.tan(scene.theta)
    half = _BAR * scene.width / 2
    corners = [
        np.stack([scene.element + side * half + lean * height, height], axis=-1)
        for side, height in ((-1, lower), (1, lower), (1, upper), (-1, upper))
    ]
    return 1e3 * np.stack(corners, axis=1)


def _draw_whole(axes: Axes, scene: TipScene) -> None:
    thickness = 1e3 * scene.thickness
    bottom, top = -0.45 * thickness, 1.18 * thickness
    left, right = 1e3 * (scene.element[[0, -1]] + np.array([-1, 1.7]) * scene.width)
    axes.add_collection(
        PolyCollection(
            _bars(scene, scene.shortening, np.full_like(scene.shortening, scene.thickness)),
            facecolors=np.where(scene.shortening > scene.wear, ORANGE, _BAR_COLOUR).tolist(),
            edgecolors=DARK,
            linewidths=0.5,
        )
    )
    axes.fill_between([left, right], thickness, top, facecolor=GREY, hatch="///", alpha=0.5, linewidth=0)
    axes.text(
        (left + right) / 2, (thickness + top) / 2, "rigid casing", ha="center", va="center", bbox=_LABEL
    )
    x, y = 1e3 * scene.tip_position, 1e3 * scene.tip_depth
    axes.fill_between(x, bottom, y, color=BLUE, alpha=0.35, linewidth=0)
    axes.plot(x, y, color=BLUE, linewidth=1.8, label="_tip")
    axes.text(0, 0.8 * bottom, "blade tip", ha="center", va="center", color=DARK)
    _draw_angle(axes, scene)
    _draw_force(axes, scene)
    _draw_rotation(axes, 1e3 * (scene.tip_position[-1] + scene.width), 0.55 * bottom, right)
    axes.set(xlim=(left, right), ylim=(bottom, top), aspect="equal", ylabel="height (mm)")


def _draw_angle(axes: Axes, scene: TipScene) -> None:
    """Show θ between the radial direction and the first bar."""
    foot, length = 1e3 * scene.element[0], 0.8e3 * scene.thickness
    turned = np.linspace(0, scene.theta, 20)
    axes.plot([foot, foot], [0, length], color=RED, linewidth=1.1, linestyle=":", label="_radial")
    axes.plot([foot, foot + length * np.sin(scene.theta)], [0, length * np.cos(scene.theta)], color=RED)
    axes.plot(foot + 0.9 * length * np.sin(turned), 0.9 * length * np.cos(turned), color=RED, linewidth=1.1)
    axes.annotate(
        rf"$\theta$ = {scene.theta:g} rad",
        (foot + 0.45 * length, 0.4 * length),
        va="center",
        color=RED,
        bbox=_LABEL,
    )


def _draw_force(axes: Axes, scene: TipScene) -> None:
    """Mark the interface node and the direction of the force on it, which is that of the bars."""
    height, length = 1e3 * scene.tip_depth.max(), 0.27e3 * scene.thickness
    end = (-length * np.sin(scene.theta), height - length * np.cos(scene.theta))
    axes.annotate("", end, (0, height), arrowprops={"arrowstyle": "-|>", "color": RED, "linewidth": 1.5})
    axes.annotate("$F^c$", end, xytext=(-4, 2), textcoords="offset points", color=RED, ha="right")
    axes.plot(0, height, marker="o", markersize=6, color=RED, linestyle="none", label="interface node")
    axes.legend(loc="lower left")


def _draw_rotation(axes: Axes, x: float, y: float, right: float) -> None:
    end = x + 0.35 * (right - x)
    axes.annotate("", (end, y), (x, y), arrowprops={"arrowstyle": "-|>", "color": DARK, "linewidth": 1.2})
    axes.text(end, y, r"  rotation, $e_\theta$", va="center")


def _draw_ends(axes: Axes, scene: TipScene) -> None:
    x, width = 1e3 * scene.element, 1e3 * _BAR * scene.width
    depth, wear = 1e6 * scene.shortening, 1e6 * scene.wear
    top = 1.45 * depth.max()
    line = {"edgecolor": DARK, "linewidth": 0.5}
    axes.bar(x, top - depth, width, depth, color=_BAR_COLOUR, label="element", **line)
    axes.bar(x, depth - wear, width, wear, color=ORANGE, label="elastic shortening", **line)
    axes.bar(x, wear, width, color="white", hatch="////", label="permanent shortening: wear", **line)
    axes.plot(
        1e3 * scene.tip_position, 1e6 * scene.tip_depth, color=BLUE, linewidth=2, label="blade tip", zorder=4
    )
    axes.plot(0, 1e6 * scene.tip_depth.max(), marker="o", markersize=6, color=RED, zorder=5, label="_node")
    axes.axhline(0, color=DARK, linewidth=0.8, linestyle=(0, (4, 2)), label="original surface")
    axes.set(
        ylim=(-0.15 * depth.max(), top),
        xlabel="distance from the interface node along the circumference (mm)",
        ylabel="height over the\noriginal surface (µm)",
    )
    axes.figure.legend(
        *axes.get_legend_handles_labels(),
        loc="outside lower center",
        ncols=5,
        handlelength=1.4,
        columnspacing=1.0,
    )
