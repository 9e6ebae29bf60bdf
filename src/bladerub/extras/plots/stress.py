"""The largest stress of the blade at the peaks of the study."""

from itertools import cycle

import pandas as pd
from matplotlib.figure import Figure

from bladerub.plots import style
from bladerub.plots.scales import Scales

_COLOURS = (style.BLUE, style.ORANGE, style.RED, style.VIOLET, style.DARK)


@style.styled
def stress(table: pd.DataFrame, scales: Scales) -> Figure:
    """Draw the stress of the last revolutions over speed and displacement, a colour for each engine order.

    `table` is from `bladerub.extras.stress.run`, `scales` the blade.
    """
    figure = style.new_figure(style.PAGE, 0.55 * style.PAGE)
    over_speed, over_displacement = figure.subplots(1, 2)
    looks = zip(cycle("os^vDP"), cycle(_COLOURS), strict=False)
    for (order, rows), (marker, colour) in zip(table.groupby("order"), looks, strict=False):
        look = {"marker": marker, "color": colour, "ls": "none", "ms": 3, "mfc": "none"}
        over_speed.plot(rows.f_peak, rows.last_von_mises / 1e6, label=f"eo({order:g})", **look)
        over_displacement.plot(1e3 * rows.amplitude, rows.last_alternating / 1e6, **look)
    rotation = table.sort_values("f_peak")
    over_speed.plot(
        rotation.f_peak, rotation.rotation_von_mises / 1e6, color=style.GREY, label="rotation alone"
    )
    over_speed.set(xlabel=r"rotational frequency $f_\Omega$ (normalised)", ylim=(0, None))
    over_speed.set_ylabel("largest von Mises stress (MPa)")
    scales.add_speeds(over_speed, "x")
    over_displacement.set(xlabel="amplitude at the peak (mm)", ylabel="alternating stress (MPa)")
    over_displacement.set(xlim=(0, None), ylim=(0, None))
    handles, labels = over_speed.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))  # hides no peak
    return figure
