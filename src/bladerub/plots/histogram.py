"""A quantity over Young modulus and plastic modulus: bars like the paper's, and a map to read from."""

from typing import NamedTuple

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d import Axes3D

from bladerub.plots import titles
from bladerub.plots.scales import greatest
from bladerub.plots.style import HEIGHT_MAP, MISSING, PAGE, RED, new_figure, styled

_BAR = 0.62  # width of a bar, in steps of the moduli
_ROOM = 0.01  # from the floor to the lowest speed, normalised: it is seen, and the differences too


class Heights(NamedTuple):
    """A quantity over the moduli as it is drawn: amplitudes in mm, speeds normalised."""

    values: pd.DataFrame  # over E (rows) and K (columns), ascending; NaN for none
    label: str
    digits: int
    norm: Normalize  # of their colours

    @classmethod
    def of(cls, peaks: pd.DataFrame, quantity: str, order: int) -> "Heights":
        """Take ``amplitude`` or ``f_peak`` of an engine `order`; parameters as of `peak_histogram`."""
        table = peaks[peaks.order == order].pivot(index="E", columns="K", values=quantity).astype(float)
        if quantity == "amplitude":
            return cls(1e3 * table, f"$Y_{order}$ (mm)", 2, Normalize(0.0, 1e3 * greatest(table.to_numpy())))
        top = greatest(table.to_numpy())
        norm = Normalize(np.fmin.reduce(table.to_numpy(), axis=None, initial=top) - _ROOM, top)
        rpm = (peaks.get("f_peak_rpm", np.nan) / peaks["f_peak"]).mean()
        unit = f"in units of {rpm:.0f} rpm" if rpm > 0 else "normalised"
        return cls(table, f"rotational frequency $f_{order}$ ({unit})", 3, norm)


@styled
def peak_histogram(
    peaks: pd.DataFrame, quantity: str, order: int, unit: float
) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 11 to 14 over (E, K), as 3D bars (a) and as an annotated map (b).

    The `quantity` is ``amplitude``, drawn in mm, or ``f_peak`` of `peaks`, rows of ``peaks.csv`` of one
    casing and one theta; the table is those of the engine `order`. The moduli are drawn as equal steps, NaN
    as no bar and a grey field with a dash. E = 1 and K = 1 are `unit`, Pa.
    """
    heights = Heights.of(peaks, quantity, order)
    figure = new_figure(PAGE, 0.52 * PAGE)
    bar_cell, map_cell = figure.add_gridspec(1, 2, width_ratios=[1.1, 1])
    bars, colours = figure.add_subplot(bar_cell, projection="3d"), figure.add_subplot(map_cell)
    _draw_bars(bars, heights)
    draw_map(colours, heights)
    colours.set(**titles.moduli_axes(unit))
    bars.set_title(f"(a) {heights.label}", loc="left")
    colours.set_title("(b) maximum framed" if quantity == "amplitude" else "(b)")
    for i, j in np.argwhere((heights.values.to_numpy() == heights.norm.vmax) & (quantity == "amplitude")):
        frame = {"fill": False, "edgecolor": RED, "linewidth": 2, "clip_on": False}
        colours.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, **frame))
    columns = ["casing", "E", "K", "theta", "order", quantity]
    return peaks.loc[peaks.order == order, columns], figure


def _draw_bars(axes: Axes3D, heights: Heights) -> None:
    values, norm = heights.values.to_numpy(), heights.norm
    i, j = np.nonzero(~np.isnan(values))
    top = values[i, j]
    look = {"color": colormaps[HEIGHT_MAP](norm(top)), "edgecolor": "#202020", "linewidth": 0.25}
    if top.size:  # matplotlib cannot draw none
        axes.bar3d(i - _BAR / 2, j - _BAR / 2, norm.vmin, _BAR, _BAR, top - norm.vmin, **look)
    n_E, n_K = values.shape
    axes.set(xlim=(-0.6, n_E - 0.4), ylim=(-0.6, n_K - 0.4), zlim=(norm.vmin, norm.vmax))
    axes.set(xlabel="E", ylabel="K")
    _name_moduli(axes, heights)
    axes.zaxis.set_major_locator(MaxNLocator(nbins=5))
    axes.tick_params(pad=-2, labelsize=min(6.5, 55 / n_E))
    axes.view_init(elev=32, azim=-60)
    axes.set_box_aspect((1.5, 1.1, 0.9), zoom=1.12)


def draw_map(axes: Axes, heights: Heights) -> None:
    """Draw `heights` as colours, each with its number, over the places of E and K."""
    values, norm = heights.values.to_numpy(), heights.norm
    n_E, n_K = values.shape
    E_edges, K_edges = np.arange(n_E + 1) - 0.5, np.arange(n_K + 1) - 0.5
    look = {"cmap": HEIGHT_MAP, "norm": norm, "edgecolors": "white", "linewidth": 0.8}
    mesh = axes.pcolormesh(E_edges, K_edges, np.ma.masked_invalid(values.T), **look)
    size = min(7.0, 60 / n_E)
    for (i, j), value in np.ndenumerate(values):
        text = "–" if np.isnan(value) else f"{value:.{heights.digits}f}"
        on_dark = not np.isnan(value) and norm(value) < 0.6
        axes.text(i, j, text, ha="center", va="center", fontsize=size, color="white" if on_dark else "black")
    _name_moduli(axes, heights)
    axes.set_facecolor(MISSING)
    bar = axes.figure.colorbar(mesh, ax=axes, label=heights.label, location="bottom", aspect=30)
    bar.locator = MaxNLocator(nbins=5)


def _name_moduli(axes: Axes, heights: Heights) -> None:
    axes.set_xticks(range(heights.values.index.size), [f"{E:g}" for E in heights.values.index])
    axes.set_yticks(range(heights.values.columns.size), [f"{K:g}" for K in heights.values.columns])
