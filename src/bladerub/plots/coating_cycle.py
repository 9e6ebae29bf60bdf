"""Stress–strain cycle of an abradable element with its slopes and its elastic limit."""

from collections.abc import Mapping

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.contact.illustration import LoadingCycle
from bladerub.plots import titles
from bladerub.plots.style import BLUE, DARK, GREY, ORANGE, PAGE, new_figure, styled

_PLASTIC = {"color": DARK, "linewidth": 2.4, "solid_capstyle": "butt", "label": "plastic loading"}
_ELASTIC = {"color": ORANGE, "lw": 1.4, "ls": (0, (4, 1.5)), "label": "elastic: unloading, reloading"}
_REMAINING = {"color": BLUE, "marker": "v", "ms": 6, "ls": "none"}
_REMAINING |= {"label": r"plastic strain $\varepsilon^p$ that remains (wear)"}


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
