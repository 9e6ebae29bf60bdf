"""Stress–strain cycle of the coating with its slopes and its elastic limit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, new_figure, styled

_LOADING = {"color": DARK, "linewidth": 2.4, "solid_capstyle": "butt"}
_ELASTIC = {"color": ORANGE, "linewidth": 1.4, "linestyle": (0, (4, 1.5))}


@dataclass(frozen=True)
class Cycle:
    """A computed cycle of loading and unloading.

    Parameters
    ----------
    title : str
        What is shown.
    strain, stress, plastic_strain : (n,) ndarray
        Compressive, along the path; stress normalised.
    E, K, yield_stress : float
        Young modulus, plastic modulus and elastic limit, normalised.
    """

    title: str
    strain: np.ndarray
    stress: np.ndarray
    plastic_strain: np.ndarray
    E: float
    K: float
    yield_stress: float

    @property
    def tangent_modulus(self) -> float:
        """Slope of plastic loading, ``E_T = E K / (E + K)``."""
        return self.E * self.K / (self.E + self.K)


@styled
def coating_cycle(cycles: list[Cycle]) -> Figure:
    """Draw Fig. 4: a panel for each cycle, with E, E_T, σ_Y and the plastic strain that remains."""
    figure = new_figure(PAGE, 0.5 * PAGE)
    panels = figure.subplots(1, len(cycles), sharex=True, squeeze=False)[0]
    for axes, cycle in zip(panels, cycles, strict=True):
        _draw_cycle(axes, cycle)
        axes.set(
            title=cycle.title,
            xlim=(0, 1.1 * cycle.strain.max()),
            ylim=(0, 1.12 * cycle.stress.max()),
            xlabel=r"compressive strain $\varepsilon$",
        )
    panels[0].set_ylabel(r"compressive stress $\sigma$ (normalised)")
    figure.legend(*panels[0].get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _draw_cycle(axes: Axes, cycle: Cycle) -> None:
    flows = np.append(np.diff(cycle.plastic_strain) > 0, False)
    flows |= np.roll(flows, 1)  # both ends of a flowing step
    touched = cycle.stress > 0
    axes.plot(
        cycle.strain,
        np.where(touched & ~flows, cycle.stress, np.nan),
        label="elastic: unloading, reloading",
        **_ELASTIC,
    )
    axes.plot(cycle.strain, np.where(flows, cycle.stress, np.nan), label="plastic loading", **_LOADING)
    remaining = _remaining(cycle)
    axes.plot(
        remaining,
        np.zeros(remaining.size),
        marker="v",
        markersize=6,
        linestyle="none",
        color=BLUE,
        clip_on=False,
        zorder=4,
        label=r"plastic strain $\varepsilon^p$ that remains (wear)",
    )
    note = rf"$\sigma_Y$ = {cycle.yield_stress:g}"
    if cycle.yield_stress > 0.02 * cycle.stress.max():
        axes.axhline(cycle.yield_stress, color=GREY, linestyle=":", linewidth=0.9, label="_yield")
        axes.text(1.09 * cycle.strain.max(), 0.98 * cycle.yield_stress, note, ha="right", va="top")
    else:
        axes.text(0.02, 0.93, note + ": too small to be seen", transform=axes.transAxes)
    _mark_slopes(axes, cycle)


def _remaining(cycle: Cycle) -> np.ndarray:
    """Find the plastic strains at which the bar comes free."""
    free = (cycle.stress[1:] == 0) & (cycle.stress[:-1] > 0)
    return cycle.plastic_strain[1:][free]


def _mark_slopes(axes: Axes, cycle: Cycle) -> None:
    """Draw a slope triangle under the last unloading, and one under the last loading."""
    top = int(np.argmax(cycle.stress))
    strain, stress = cycle.strain[top], cycle.stress[top]
    beside, below = {"ha": "left", "va": "center"}, {"ha": "center", "va": "top"}
    for name, slope, share, place in (
        ("E", cycle.E, 0.6, beside),
        ("E_T", cycle.tangent_modulus, 0.08, below),
    ):
        rise = min(0.22 * stress, 0.22 * slope * strain)
        run = rise / slope
        # the upper corner lies on the branch, `share` of the stress below its end
        x, y = strain - share * stress / slope, stress * (1 - share)
        axes.plot([x - run, x, x], [y - rise, y - rise, y], color=GREY, linewidth=0.9, label="_slope")
        corner = (x, y - rise / 2) if place is beside else (x - run / 2, y - rise)
        away = (3, 0) if place is beside else (0, -3)
        axes.annotate(f"${name}$ = {slope:g}", corner, xytext=away, textcoords="offset points", **place)
