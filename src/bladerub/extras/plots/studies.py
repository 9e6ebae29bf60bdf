"""Figures of single studies: Coulomb friction, stress at the peaks, rub rigs."""

from itertools import cycle

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from bladerub.plots import style
from bladerub.plots.scales import UNKNOWN, Scales

_MARKERS = "os^vDP"
_COLOURS = (style.DARK, style.ORANGE, style.BLUE, style.RED, style.GREY, style.VIOLET)  # of coatings
_ORDER_COLOURS = (style.BLUE, style.ORANGE, style.RED, style.VIOLET, style.DARK)
_NONE = 1e-12  # relative difference that is drawn for none on the logarithmic axis
_FORCES = {"normal_force": ("normal", style.BLUE, 1.0), "tangential_force": ("tangential", style.ORANGE, 1.0)}
_DEPTHS = {"tip_depth": ("of the tip", style.BLUE, 1e6), "worn_depth": ("worn", style.ORANGE, 1e6)}


@style.styled
def friction(table: pd.DataFrame, scales: Scales = UNKNOWN) -> Figure:
    """Draw difference of peaks and slowest sliding of `extras.friction.table`, a colour for each coating."""
    figure = style.new_figure(style.PAGE, 0.85 * style.PAGE)
    difference, sliding = figure.subplots(2, 1, sharex=True)
    for number, ((casing, E, K, theta), rows) in enumerate(table.groupby(["casing", "E", "K", "theta"])):
        colour, marker = _COLOURS[number % 6], _MARKERS[number % 6]
        look = {"color": colour, "marker": marker, "ms": 2.5, "lw": 0.6}
        name = f"{casing}, E = {E:g}, K = {K:g}, θ = {theta:g}"
        difference.semilogy(rows.f_omega, np.maximum(rows.difference.abs(), _NONE), label=name, **look)
        sliding.plot(rows.f_omega, rows.slowest_sliding, **look)
    difference.set_ylabel("relative difference\nof the peak, Coulomb to θ")
    difference.axhline(0.01, color=style.GREY, linestyle=":")
    difference.legend(ncols=2, loc="upper right")
    top = difference.get_ylim()[1]
    difference.set_ylim(_NONE / 2, max(top, 1.0) * 1e4)  # room for the names
    turned = table[table.slowest_sliding < 0]
    difference.set_title(f"sliding turns in {len(turned)} of {len(table)} runs with θ")
    sliding.axhline(0, color=style.GREY)
    sliding.set_ylabel("slowest sliding\nover that by the rotation")
    sliding.set_ylim(max(-2.0, min(-0.1, 1.1 * table.slowest_sliding.min())), 1.05)
    sliding.set_xlabel(r"rotational frequency $f_\Omega$ (normalised)")
    scales.add_speeds(sliding, "x")
    return figure


@style.styled
def stress(table: pd.DataFrame, scales: Scales) -> Figure:
    """Draw the stress (`extras.stress.run`) over speed and displacement, a colour for each engine order."""
    figure = style.new_figure(style.PAGE, 0.55 * style.PAGE)
    over_speed, over_displacement = figure.subplots(1, 2)
    looks = zip(cycle(_MARKERS), cycle(_ORDER_COLOURS), strict=False)
    for (order, rows), (marker, colour) in zip(table.groupby("order"), looks, strict=False):
        look = {"marker": marker, "color": colour, "ls": "none", "ms": 3, "mfc": "none"}
        over_speed.plot(rows.f_peak, rows.last_von_mises / 1e6, label=f"eo({order:g})", **look)
        over_displacement.plot(1e3 * rows.amplitude, rows.last_alternating / 1e6, **look)
    rotation = table.sort_values("f_peak")
    look = {"color": style.GREY, "label": "rotation alone"}
    over_speed.plot(rotation.f_peak, rotation.rotation_von_mises / 1e6, **look)
    over_speed.set(xlabel=r"rotational frequency $f_\Omega$ (normalised)", ylim=(0, None))
    over_speed.set_ylabel("largest von Mises stress (MPa)")
    scales.add_speeds(over_speed, "x")
    over_displacement.set(xlabel="amplitude at the peak (mm)", ylabel="alternating stress (MPa)")
    over_displacement.set(xlim=(0, None), ylim=(0, None))
    handles, labels = over_speed.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))  # hides no peak
    return figure


@style.styled
def rigs(passes: pd.DataFrame, compared: pd.DataFrame) -> Figure:
    """Draw forces and worn depth of each rig over its passes (`extras.rig.passes`), and the measured ones."""
    names = list(passes.rig.unique())
    figure = style.new_figure(style.PAGE, 0.3 * style.PAGE * len(names))
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
