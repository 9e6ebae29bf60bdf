"""A quantity over Young modulus and plastic modulus: bars like the paper's, and a map to read from."""

import numpy as np
import pandas as pd
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.ticker import MaxNLocator
from mpl_toolkits.mplot3d import Axes3D

from bladerub.plots.style import HEIGHT_MAP, MISSING, PAGE, RED, new_figure, styled

_BAR = 0.62  # width of a bar, in steps of the moduli
_ROOM = 0.01  # from the floor to the lowest speed, normalised: it is seen, and the differences too


def peak_histogram(peaks: pd.DataFrame, quantity: str, order: int) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 11 to 14: the column ``amplitude`` or ``f_peak`` of ``peaks.csv`` over (E, K).

    `peaks` are the rows of one casing and one theta. Returns those of the `order`, which are drawn, and the
    figure, with amplitudes in mm.
    """
    rows = peaks.loc[peaks.order == order, ["casing", "E", "K", "theta", "order", quantity]]
    values = rows.pivot(index="E", columns="K", values=quantity)
    if quantity == "amplitude":
        return rows, histogram(1e3 * values, f"$Y_{order}$ (mm)", digits=2)
    label, floor = f"rotational frequency $f_{order}$ (normalised)", values.min(axis=None) - _ROOM
    return rows, histogram(values, label, digits=3, floor=floor, frame_maximum=False)


@styled
def histogram(
    table: pd.DataFrame, label: str, digits: int, floor: float = 0.0, frame_maximum: bool = True
) -> Figure:
    """Draw a quantity over E (rows) and K (columns) as 3D bars (a) and as an annotated map (b).

    The moduli are drawn as equal steps, NaN as no bar and a grey field with a dash; a `table` of NaN alone
    is a ValueError. Bars and colours begin at the `floor`.
    """
    values = table.to_numpy(dtype=float)
    if np.isnan(values).all():
        raise ValueError(f"{label}: nothing to draw, every (E, K) is missing")
    norm = Normalize(floor, np.nanmax(values))
    figure = new_figure(PAGE, 0.52 * PAGE)
    left, right = figure.add_gridspec(1, 2, width_ratios=[1.1, 1])
    bars, colours = figure.add_subplot(left, projection="3d"), figure.add_subplot(right)
    _draw_bars(bars, values, norm)
    _draw_map(colours, values, label, digits, norm)
    for axes in (bars, colours):
        axes.set_xticks(range(len(table.index)), [f"{E:g}" for E in table.index])
        axes.set_yticks(range(len(table.columns)), [f"{K:g}" for K in table.columns])
    bars.set_title(f"(a) {label}", loc="left")
    colours.set_title("(b) maximum framed" if frame_maximum else "(b)")
    if frame_maximum:
        for i, j in np.argwhere(values == np.nanmax(values)):
            frame = {"fill": False, "edgecolor": RED, "linewidth": 2, "clip_on": False}
            colours.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, **frame))
    return figure


def _draw_bars(axes: Axes3D, values: np.ndarray, norm: Normalize) -> None:
    i, j = np.nonzero(~np.isnan(values))
    top = values[i, j]
    axes.bar3d(
        i - _BAR / 2,
        j - _BAR / 2,
        norm.vmin,
        _BAR,
        _BAR,
        top - norm.vmin,
        color=colormaps[HEIGHT_MAP](norm(top)),
        edgecolor="#202020",
        linewidth=0.25,
    )
    n_E, n_K = values.shape
    axes.set(xlim=(-0.6, n_E - 0.4), ylim=(-0.6, n_K - 0.4), zlim=(norm.vmin, norm.vmax))
    axes.set(xlabel="E", ylabel="K")
    axes.zaxis.set_major_locator(MaxNLocator(nbins=5))
    axes.tick_params(pad=-2, labelsize=min(6.5, 55 / n_E))
    axes.view_init(elev=32, azim=-60)
    axes.set_box_aspect((1.5, 1.1, 0.9), zoom=1.12)


def _draw_map(axes: Axes, values: np.ndarray, label: str, digits: int, norm: Normalize) -> None:
    n_E, n_K = values.shape
    mesh = axes.pcolormesh(
        np.arange(n_E + 1) - 0.5,
        np.arange(n_K + 1) - 0.5,
        np.ma.masked_invalid(values.T),
        cmap=HEIGHT_MAP,
        norm=norm,
        edgecolors="white",
        linewidth=0.8,
    )
    size = min(7.0, 60 / n_E)
    for (i, j), value in np.ndenumerate(values):
        text = "–" if np.isnan(value) else f"{value:.{digits}f}"
        on_dark = not np.isnan(value) and norm(value) < 0.6
        axes.text(i, j, text, ha="center", va="center", fontsize=size, color="white" if on_dark else "black")
    axes.set(
        facecolor=MISSING, xlabel="Young modulus E (normalised)", ylabel="plastic modulus K (normalised)"
    )
    bar = axes.figure.colorbar(mesh, ax=axes, label=label, location="bottom", aspect=30)
    bar.locator = MaxNLocator(nbins=5)
