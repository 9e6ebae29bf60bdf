"""The largest stress of the blade at the peaks of the study."""

import pandas as pd
from matplotlib.figure import Figure

from bladerub.plots import style

_MARKERS = "os^vDP"
_COLOURS = (style.BLUE, style.ORANGE, style.RED, style.VIOLET, style.DARK)


@style.styled
def stress(table: pd.DataFrame) -> Figure:
    """Draw the stress of the last revolutions over speed and displacement, a colour for each engine order.

    `table` is from `bladerub.extras.stress.table`.
    """
    figure = style.new_figure(style.PAGE, 0.45 * style.PAGE)
    over_speed, over_displacement = figure.subplots(1, 2)
    for number, (order, rows) in enumerate(table.groupby("order")):
        look = {
            "marker": _MARKERS[number % len(_MARKERS)],
            "color": _COLOURS[number % len(_COLOURS)],
            "ls": "none",
            "ms": 3,
            "mfc": "none",
        }
        name = f"eo({order:g})"
        over_speed.plot(rows.f_peak, rows.last_von_mises / 1e6, label=name, **look)
        over_displacement.plot(1e3 * rows.amplitude, rows.last_alternating / 1e6, **look)
    rotation = table.sort_values("f_peak")
    over_speed.plot(
        rotation.f_peak, rotation.rotation_von_mises / 1e6, color=style.GREY, label="rotation alone"
    )
    over_speed.set_xlabel(r"rotational frequency $f_\Omega$ (normalised)")
    over_speed.set_ylabel("largest von Mises stress (MPa)")
    over_displacement.set_xlabel("amplitude at the peak (mm)")
    over_displacement.set_ylabel("alternating stress (MPa)")
    over_displacement.set_xlim(left=0)
    for axes in (over_speed, over_displacement):
        axes.set_ylim(bottom=0)
    handles, labels = over_speed.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))  # hides no peak
    return figure
