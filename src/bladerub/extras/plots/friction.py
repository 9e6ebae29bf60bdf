"""Where Coulomb friction differs from a contact force of constant direction."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.plots import style
from bladerub.plots.scales import UNKNOWN, Scales

NONE = 1e-12  # relative difference that is drawn for none on the logarithmic axis
COLOURS = (style.DARK, style.ORANGE, style.BLUE, style.RED, style.GREY, style.VIOLET)


@style.styled
def friction(table: pd.DataFrame, scales: Scales = UNKNOWN) -> Figure:
    """Draw the difference of the peaks and the slowest sliding over the speed, a colour for each coating.

    `table` is from `bladerub.extras.friction.table.table`, `scales` the blade.
    """
    figure = style.new_figure(style.PAGE, 0.85 * style.PAGE)
    difference, sliding = figure.subplots(2, 1, sharex=True)
    for number, ((casing, E, K, theta), rows) in enumerate(table.groupby(["casing", "E", "K", "theta"])):
        colour, marker = COLOURS[number % len(COLOURS)], "os^vDP"[number % 6]
        look = {"color": colour, "marker": marker, "ms": 2.5, "lw": 0.6}
        name = f"{casing}, E = {E:g}, K = {K:g}, θ = {theta:g}"
        difference.semilogy(rows.f_omega, np.maximum(rows.difference.abs(), NONE), label=name, **look)
        sliding.plot(rows.f_omega, rows.slowest_sliding, **look)
    difference.set_ylabel("relative difference\nof the peak, Coulomb to θ")
    difference.axhline(0.01, color=style.GREY, linestyle=":")
    difference.legend(ncols=2, loc="upper right")
    top = difference.get_ylim()[1]
    difference.set_ylim(NONE / 2, max(top, 1.0) * 1e4)  # room for the names
    turned = table[table.slowest_sliding < 0]
    difference.set_title(f"sliding turns in {len(turned)} of {len(table)} runs with θ")
    sliding.axhline(0, color=style.GREY)
    sliding.set_ylabel("slowest sliding\nover that by the rotation")
    sliding.set_ylim(max(-2.0, min(-0.1, 1.1 * table.slowest_sliding.min())), 1.05)
    sliding.set_xlabel(r"rotational frequency $f_\Omega$ (normalised)")
    scales.add_speeds(sliding, "x")
    return figure
