"""Stress–strain cycles of one element by the laws beside the paper's, for some of their parameters."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from bladerub.contact.illustration import LoadingCycle, loading_cycle
from bladerub.contact.spec import PLASTIC, Coating
from bladerub.extras.heat import LAYER
from bladerub.extras.law_reading import described_law
from bladerub.plots import style

STRAINS = (0.0, 0.03, 0.0, 0.05, 0.0)  # those of Fig. 4
STEPS = 400  # of each branch
VISCOSITY = 1e4  # Pa s
_LINES = [
    {"color": style.DARK, "linestyle": "-", "linewidth": 1.8},
    {"color": style.ORANGE, "linestyle": (0, (5, 1.5)), "linewidth": 1.5},
    {"color": style.BLUE, "linestyle": (0, (1.5, 1.2)), "linewidth": 1.5},
]

Panels = Mapping[str, Mapping[str, LoadingCycle]]  # cycles by their labels, by the title of their panel


def panels(coating: Coating) -> Panels:
    """Load an element of a `coating` by each law."""
    of_study = replace(coating, element_law=PLASTIC)

    def cycle(name: str, rate: float = 0.0, rise: float = 0.0, **parameters: Any) -> LoadingCycle:
        """Load an element by a law with these parameters at a strain rate (1/s), warmer by `rise` (K)."""
        loaded = replace(of_study, element_law=described_law(name, parameters))
        return loading_cycle(loaded, STRAINS, STEPS, rate, rise)

    ideal = {
        f"yields at {stress / 1e6:g} MPa": cycle("perfectly_plastic", yield_stress=stress)
        for stress in (4e6, 8e6)
    }
    return {
        "(a) perfectly plastic": {"linear hardening": cycle("plastic")} | ideal,
        f"(b) viscoplastic, {VISCOSITY:g} Pa s": {
            f"{rate:g}/s": cycle("viscoplastic", rate, viscosity=VISCOSITY) for rate in (1.0, 300.0, 1500.0)
        },
        "(c) brittle": {
            "never breaks": cycle("brittle", break_strain=1.0),
            "breaks at 0.7 %": cycle("brittle", break_strain=0.007),
            "breaks at 0.4 %": cycle("brittle", break_strain=0.004),
        },
        f"(d) thermal, soft at {LAYER['softening_rise']:g} K": {
            f"warmer by {rise:g} K": cycle("thermal", 0.0, rise, **LAYER) for rise in (0.0, 150.0, 300.0)
        },
    }


def table(panels: Panels) -> pd.DataFrame:
    """List the points of all cycles, a row each, with law and label."""
    parts = []
    for label, loading in (pair for cycles in panels.values() for pair in cycles.items()):
        names = {"element_law": loading.coating.element_law.label, "law_case": label}
        columns = {name: getattr(loading, name) for name in ("strain", "stress", "plastic_strain")}
        parts.append(pd.DataFrame(names | columns))
    return pd.concat(parts)


@style.styled
def draw(panels: Panels) -> Figure:
    """Draw a panel for each title, with at most three cycles by their labels; stress in MPa."""
    figure = style.new_figure(style.PAGE, 0.8 * style.PAGE)
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
