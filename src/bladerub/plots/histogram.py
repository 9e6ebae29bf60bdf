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

from bladerub.plots import titles
from bladerub.plots.scales import greatest
from bladerub.plots.style import HEIGHT_MAP, MISSING, PAGE, RED, new_figure, styled

_BAR = 0.62  # width of a bar, in steps of the moduli
_WIDE = {"amplitude": 0.1, "f_peak": 0.01}  # half a band that is hatched: relative of Y, absolute of f
_ROOM = 0.01  # from the floor to the lowest speed, normalised: it is seen, and the differences too


@styled
def peak_histogram(
    peaks: pd.DataFrame, quantity: str, order: int, unit: float
) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 11 to 14 over (E, K), as 3D bars (a) and as an annotated map (b).

    The `quantity` is ``amplitude``, drawn in mm, or ``f_peak`` of `peaks`, rows of ``peaks.csv`` of one
    casing and one theta; the table is those of the engine `order`. The moduli are drawn as equal steps, NaN
    as no bar and a grey field with a dash. Half the band of the ensemble, if there
    is one, stands below the value where it shows at its digits; a wide one is hatched. E = 1 and K = 1 are
    `unit`, Pa.
    """
    ends = [f"{quantity}_{end}" for end in ("low", "high")]
    rows = peaks.loc[peaks.order == order, ["casing", "E", "K", "theta", "order", quantity, *ends]]
    table, is_amplitude = rows.pivot(index="E", columns="K", values=quantity), quantity == "amplitude"
    low, high = (rows.pivot(index="E", columns="K", values=end).to_numpy(dtype=float) for end in ends)
    half = (1e3 if is_amplitude else 1) * (high - low) / 2
    label = f"$Y_{order}$ (mm)" if is_amplitude else f"rotational frequency $f_{order}$ (normalised)"
    values = (1e3 if is_amplitude else 1) * table.to_numpy(dtype=float)
    top = greatest(values)
    lowest = np.min(values, where=values == values, initial=top)
    norm = Normalize(0.0 if is_amplitude else lowest - _ROOM, top)
    figure = new_figure(PAGE, 0.52 * PAGE)
    bar_cell, map_cell = figure.add_gridspec(1, 2, width_ratios=[1.1, 1])
    bars, colours = figure.add_subplot(bar_cell, projection="3d"), figure.add_subplot(map_cell)
    _draw_bars(bars, values, norm)
    _draw_map(colours, values, half, label, 2 if is_amplitude else 3, norm)
    wide = half > _WIDE[quantity] * (values if is_amplitude else 1)
    for i, j in np.argwhere(wide):
        hatched = {"fill": False, "edgecolor": "white", "linewidth": 0, "hatch": "////", "alpha": 0.45}
        colours.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, **hatched))
    for axes in (bars, colours):
        axes.set_xticks(range(len(table.index)), [f"{E:g}" for E in table.index])
        axes.set_yticks(range(len(table.columns)), [f"{K:g}" for K in table.columns])
    colours.set(**titles.moduli_axes(unit))
    bars.set_title(f"(a) {label}", loc="left")
    notes = ["maximum framed"] if is_amplitude else []
    notes += ["± 90 % band"] if np.isfinite(half).any() else []
    notes += [f"hatched above {'10 %' if is_amplitude else '0.01'}"] if wide.any() else []
    colours.set_title(f"(b) {', '.join(notes)}".strip())
    for i, j in np.argwhere((values == top) & is_amplitude):
        frame = {"fill": False, "edgecolor": RED, "linewidth": 2, "clip_on": False}
        colours.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, **frame))
    return rows, figure


def _draw_bars(axes: Axes3D, values: np.ndarray, norm: Normalize) -> None:
    i, j = np.nonzero(~np.isnan(values))
    top = values[i, j]
    look = {"color": colormaps[HEIGHT_MAP](norm(top)), "edgecolor": "#202020", "linewidth": 0.25}
    if top.size:  # matplotlib cannot draw none
        axes.bar3d(i - _BAR / 2, j - _BAR / 2, norm.vmin, _BAR, _BAR, top - norm.vmin, **look)
    n_E, n_K = values.shape
    axes.set(xlim=(-0.6, n_E - 0.4), ylim=(-0.6, n_K - 0.4), zlim=(norm.vmin, norm.vmax))
    axes.set(xlabel="E", ylabel="K")
    axes.zaxis.set_major_locator(MaxNLocator(nbins=5))
    axes.tick_params(pad=-2, labelsize=min(6.5, 55 / n_E))
    axes.view_init(elev=32, azim=-60)
    axes.set_box_aspect((1.5, 1.1, 0.9), zoom=1.12)


def _draw_map(
    axes: Axes, values: np.ndarray, half: np.ndarray, label: str, digits: int, norm: Normalize
) -> None:
    n_E, n_K = values.shape
    E_edges, K_edges = np.arange(n_E + 1) - 0.5, np.arange(n_K + 1) - 0.5
    look = {"cmap": HEIGHT_MAP, "norm": norm, "edgecolors": "white", "linewidth": 0.8}
    mesh = axes.pcolormesh(E_edges, K_edges, np.ma.masked_invalid(values.T), **look)
    size = min(7.0, 60 / n_E)
    for (i, j), value in np.ndenumerate(values):
        text = "–" if np.isnan(value) else f"{value:.{digits}f}"
        if half[i, j] >= 0.5 * 10**-digits:
            text += f"\n±{half[i, j]:.{digits}f}"
        on_dark = not np.isnan(value) and norm(value) < 0.6
        axes.text(i, j, text, ha="center", va="center", fontsize=size, color="white" if on_dark else "black")
    axes.set_facecolor(MISSING)
    bar = axes.figure.colorbar(mesh, ax=axes, label=label, location="bottom", aspect=30)
    bar.locator = MaxNLocator(nbins=5)
