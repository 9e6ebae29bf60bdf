"""Forces and wear of a tip that is fed into a coated disk, pass by pass."""

import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots.style import BLUE, ORANGE, PAGE, new_figure, styled

_FORCES = {"normal_force": ("normal", BLUE, 1.0), "tangential_force": ("tangential", ORANGE, 1.0)}
_DEPTHS = {"tip_depth": ("of the tip", BLUE, 1e6), "worn_depth": ("worn", ORANGE, 1e6)}


@styled
def rigs(passes: pd.DataFrame, compared: pd.DataFrame) -> Figure:
    """Draw forces and worn depth of each rig over its passes, and what was measured in the last one.

    `passes` and `compared` are of `bladerub.extras.rig.passes`.
    """
    names = list(passes.rig.unique())
    figure = new_figure(PAGE, 0.3 * PAGE * len(names))
    grid = figure.subplots(len(names), 2, squeeze=False)
    for (forces, depths), name in zip(grid, names, strict=True):
        rig_passes = passes[passes.rig == name]
        number = rig_passes["pass"]
        measured = compared[compared.rig == name].set_index("quantity").measured_on_rig
        marker = "o" if len(rig_passes) == 1 else None
        for axes, columns in ((forces, _FORCES), (depths, _DEPTHS)):
            for column, (label, colour, factor) in columns.items():
                axes.plot(number, factor * rig_passes[column], color=colour, marker=marker, label=label)
                if column in measured and pd.notna(measured[column]):
                    axes.plot(number.iloc[-1], factor * measured[column], "x", color=colour)
            axes.set(xlim=(0, 1.05 * len(rig_passes)), ylim=(0, 1.1 * axes.get_ylim()[1]), xlabel="pass")
            axes.xaxis.set_major_locator(MaxNLocator(integer=True))
            axes.legend(loc="best", frameon=False)
        forces.set(title=f"{name}: force, N")
        depths.set(title=f"{name}: depth, µm")
    return figure
