"""Campbell diagram: eigenfrequencies of the finite element model and of the reduced model over the speed."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from bladerub.plots import engine_orders
from bladerub.plots.style import DARK, ORANGE, PAGE, new_figure, styled


@styled
def campbell(f_omega: np.ndarray, f_fe: np.ndarray, f_rom: np.ndarray, orders: range) -> Figure:
    """Draw Fig. 2: all modes (a) and the first of them, which the engine `orders` cross (b).

    Finite elements `f_fe` dashed on top of the reduced model `f_rom`, solid: eigenfrequencies (n, n_modes),
    ascending, NaN where unknown, at the speeds `f_omega` (n,); all normalised.
    """
    f_omega, f_fe, f_rom = np.asarray(f_omega), np.asarray(f_fe), np.asarray(f_rom)
    figure = new_figure(PAGE, 0.62 * PAGE)
    whole, first = figure.subplots(1, 2)
    speed_max = float(f_omega.max())
    whole_max, first_max = 1.04 * float(np.nanmax([f_fe, f_rom])), 1.5 * float(np.nanmax(f_rom[:, 0]))
    engine_orders.draw(whole, {k: k for k in orders[-1:]}, speed_max, whole_max)
    engine_orders.draw(first, {k: k for k in orders}, speed_max, first_max)
    for axes in (whole, first):
        _modes(axes, f_omega, f_fe, f_rom)
        axes.set(xlim=(0, speed_max), xlabel=r"rotational frequency $f_\Omega\,/\,f_1(0)$")
    whole.set(ylim=(0, whole_max), ylabel=r"eigenfrequency $f\,/\,f_1(0)$")
    whole.set_title(f"(a) first {f_rom.shape[1]} modes", pad=16)
    first.set(ylim=(0, first_max))
    first.set_title("(b) first mode, $C_1$", pad=16)
    figure.legend(*whole.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    return figure


def _modes(axes: Axes, f_omega: np.ndarray, f_fe: np.ndarray, f_rom: np.ndarray) -> None:
    for mode in range(f_rom.shape[1]):
        rom, fe = ("reduced model", "finite elements") if mode == 0 else ("_rom", "_fe")
        axes.plot(f_omega, f_rom[:, mode], color=ORANGE, linewidth=2.6, label=rom)
        axes.plot(f_omega, f_fe[:, mode], color=DARK, linestyle=(0, (4, 2)), linewidth=1.0, label=fe)
        at, place = (f_omega[0], f_rom[0, mode]), (3 + 10 * (mode % 2), 2.5)
        look = {"fontsize": 7, "color": DARK, "clip_on": True, "annotation_clip": True}
        axes.annotate(f"{mode + 1}", at, xytext=place, textcoords="offset points", **look)
