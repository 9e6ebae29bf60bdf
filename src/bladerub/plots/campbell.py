"""Campbell diagram: eigenfrequencies of the finite element model and of the reduced model over the speed."""

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.plots.scales import ORDERS, Scales, draw_engine_orders
from bladerub.plots.style import DARK, ORANGE, PAGE, new_figure, on_axes

_FREQUENCY = r"eigenfrequency $f\,/\,f_1(0)$"
_NUMBER = 0.045  # height of a number and what is above it, over that of the axes


@on_axes
def campbell(table: pd.DataFrame, scales: Scales, ax: Axes | None = None) -> Figure:
    """Draw Fig. 2: all modes (a) and the first of them, which the engine orders cross (b).

    The `table` is ``campbell.csv``: the frequencies of finite elements ``f_fe``, drawn dashed on top of those
    of the reduced model ``f_rom``, Hz, NaN where unknown. `scales` have f1. Axes that are given hold (b).
    """
    frequencies = table.pivot(index="f_omega", columns="mode") / scales.f1_hz
    modes = frequencies.index.to_numpy(), *(frequencies[name].to_numpy() for name in ("f_fe", "f_rom"))
    top_of_first, top = 1.5 * float(np.nanmax(modes[2][:, 0])), 1.04 * float(np.nanmax(modes[1:]))
    if ax is not None:
        _draw(ax, modes, ORDERS, top_of_first, scales)
        ax.set_ylabel(_FREQUENCY)
        ax.legend(loc="lower right")
        return ax.figure
    figure = new_figure(PAGE, 0.62 * PAGE)
    all_modes, first = figure.subplots(1, 2)
    _draw(all_modes, modes, ORDERS[-1:], top, scales)
    all_modes.set_ylabel(_FREQUENCY)
    all_modes.set_title(f"(a) first {modes[2].shape[1]} modes", pad=16)
    _draw(first, modes, ORDERS, top_of_first, scales)
    first.set_title("(b) first mode, $C_1$", pad=16)
    figure.legend(*all_modes.get_legend_handles_labels(), loc="outside lower center", ncols=4)
    return figure


def _draw(axes: Axes, modes: tuple[np.ndarray, ...], orders: range, highest: float, scales: Scales) -> None:
    f_omega, f_fe, f_rom = modes
    fastest = float(f_omega.max())
    draw_engine_orders(axes, {k: k for k in orders}, fastest, highest)
    for mode in range(f_rom.shape[1]):
        rom, fe = ("reduced model", "finite elements") if mode == 0 else ("_rom", "_fe")
        axes.plot(f_omega, f_rom[:, mode], color=ORANGE, linewidth=2.6, label=rom)
        axes.plot(f_omega, f_fe[:, mode], color=DARK, linestyle=(0, (4, 2)), linewidth=1.0, label=fe)
    axes.set(xlim=(0, fastest), ylim=(0, highest), xlabel=r"rotational frequency $f_\Omega\,/\,f_1(0)$")
    scales.add_speeds(axes, "x")
    scales.add_frequencies(axes, "y")
    scales.draw_nominal_speed(axes.axvline)
    _number(axes, f_rom[0] / highest)


def _number(axes: Axes, height: np.ndarray) -> None:
    """Write the numbers of modes at their `height` (n_modes,) over that of the axes, none over another."""
    tops: list[float] = []  # of the highest number in each column
    look = {"fontsize": 7, "color": DARK, "ha": "left", "va": "bottom", "textcoords": "offset points"}
    look["bbox"] = {"facecolor": "white", "edgecolor": "none", "alpha": 0.8, "pad": 0.3}
    for mode in np.flatnonzero(height < 1):
        free = [column for column, top in enumerate(tops) if height[mode] >= top]
        column = free[0] if free else len(tops)
        tops[column : column + 1] = [height[mode] + _NUMBER]
        anchor = (0.0, height[mode])
        axes.annotate(f"{mode + 1}", anchor, (3 + 12 * column, 1.5), xycoords="axes fraction", **look)
