"""Stress–strain cycles of an abradable element by several laws."""

from collections.abc import Mapping

from matplotlib.figure import Figure

from bladerub.contact.illustration import LoadingCycle
from bladerub.plots.style import BLUE, DARK, ORANGE, PAGE, new_figure, styled

_LINES = [
    {"color": DARK, "linestyle": "-", "linewidth": 1.8},
    {"color": ORANGE, "linestyle": (0, (5, 1.5)), "linewidth": 1.5},
    {"color": BLUE, "linestyle": (0, (1.5, 1.2)), "linewidth": 1.5},
]


@styled
def law_cycles(panels: Mapping[str, Mapping[str, LoadingCycle]]) -> Figure:
    """Draw a panel for each title, with at most three cycles by their labels; stress in MPa."""
    figure = new_figure(PAGE, 0.8 * PAGE)
    grid = figure.subplots(-(-len(panels) // 2), 2, sharex=True, sharey=True, squeeze=False)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    for axes, (title, cycles) in zip(grid.flat, panels.items(), strict=False):
        for (label, cycle), line in zip(cycles.items(), _LINES, strict=False):
            megapascal = cycle.stress * cycle.coating.modulus_unit / 1e6
            axes.plot(100 * cycle.strain, megapascal, label=label, **line)
        axes.set(title=title)
        axes.legend(loc="upper left", frameon=False)
    grid[0, 0].set(xlim=(0, None), ylim=(0, None))  # of all, which share their axes
    figure.supxlabel(r"compressive strain $\varepsilon$, %", fontsize="medium")
    figure.supylabel(r"compressive stress $\sigma$, MPa", fontsize="medium")
    return figure
