"""A quantity over Young modulus and plastic modulus: bars like the paper's, and a map to read from."""

from __future__ import annotations

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

_BAR = 0.62  # width of a bar, in cells
_ROOM = 0.01  # from the floor to the lowest speed, normalised: it is seen, and the differences too


def peak_amplitudes(peaks: pd.DataFrame, order: int) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 11 and 13 from the table of peaks: Y_k over (E, K).

    Parameters
    ----------
    peaks : DataFrame
        Rows of ``peaks.csv``, of one casing and one theta.
    order : int
        The engine order k.

    Returns
    -------
    table : DataFrame
        What is drawn: the rows of `peaks` of that order, in m.
    figure : Figure
        In mm.
    """
    rows, over_moduli = _of_order(peaks, order, "amplitude")
    E, K = over_moduli.index, over_moduli.columns
    return rows, histogram(E, K, 1e3 * over_moduli.to_numpy(), f"$Y_{order}$ (mm)", digits=2)


def peak_speeds(peaks: pd.DataFrame, order: int) -> tuple[pd.DataFrame, Figure]:
    """Draw Figs. 12 and 14 from the table of peaks: f_k over (E, K), normalised (see `peak_amplitudes`)."""
    rows, over_moduli = _of_order(peaks, order, "f_peak")
    label = f"rotational frequency $f_{order}$ (normalised)"
    floor = over_moduli.min(axis=None) - _ROOM
    E, K = over_moduli.index, over_moduli.columns
    return rows, histogram(E, K, over_moduli.to_numpy(), label, digits=3, floor=floor, frame_maximum=False)


def _of_order(peaks: pd.DataFrame, order: int, column: str) -> tuple[pd.DataFrame, pd.DataFrame]:
    """Return the rows of `peaks` with what tells them apart and `column`, and the same as E times K."""
    rows = peaks.loc[peaks.order == order, ["casing", "E", "K", "theta", "order", column]]
    return rows, rows.pivot(index="E", columns="K", values=column)


@styled
def histogram(
    E: np.ndarray,
    K: np.ndarray,
    values: np.ndarray,
    label: str,
    digits: int,
    floor: float | None = None,
    frame_maximum: bool = True,
) -> Figure:
    """Draw Figs. 11 to 14: `values` over (E, K) as 3D bars (a) and as an annotated map (b).

    Parameters
    ----------
    E, K : (n_E,), (n_K,) array_like
        Ascending moduli, normalised; drawn as equal steps.
    values : (n_E, n_K) array_like
        The quantity, NaN where it is missing: no bar, and a grey cell with a dash.
    label : str
        Name of the quantity with its unit.
    digits : int
        Decimals in the cells.
    floor : float, optional
        Where the bars stand; by default at 0.
    frame_maximum : bool, optional
        Whether the cells of the greatest value are framed: of speeds, several are equal and none stands out.

    Raises
    ------
    ValueError
        If all values are missing.
    """
    values = np.asarray(values, dtype=float)
    if np.isnan(values).all():
        raise ValueError(f"{label}: nothing to draw, every (E, K) is missing")
    floor = 0.0 if floor is None else floor
    norm = Normalize(floor, np.nanmax(values))
    figure = new_figure(PAGE, 0.52 * PAGE)
    left, right = figure.add_gridspec(1, 2, width_ratios=[1.1, 1])
    _bars(figure.add_subplot(left, projection="3d"), E, K, values, label, norm)
    cells = figure.add_subplot(right)
    _cells(cells, E, K, values, label, digits, norm)
    if frame_maximum:
        cells.set_title("(b) maximum framed")
        for i, j in np.argwhere(values == np.nanmax(values)):
            cells.add_patch(
                Rectangle((i - 0.5, j - 0.5), 1, 1, fill=False, edgecolor=RED, linewidth=2, clip_on=False)
            )
    return figure


def _bars(axes: Axes3D, E, K, values: np.ndarray, label: str, norm: Normalize) -> None:
    i, j = np.nonzero(~np.isnan(values))
    height = values[i, j]
    axes.bar3d(
        i - _BAR / 2,
        j - _BAR / 2,
        norm.vmin,
        _BAR,
        _BAR,
        height - norm.vmin,
        color=colormaps[HEIGHT_MAP](norm(height)),
        edgecolor="#202020",
        linewidth=0.25,
    )
    axes.set_xticks(range(len(E)), [f"{e:g}" for e in E])
    axes.set_yticks(range(len(K)), [f"{k:g}" for k in K])
    axes.set(
        xlim=(-0.6, len(E) - 0.4),
        ylim=(-0.6, len(K) - 0.4),
        zlim=(norm.vmin, norm.vmax),
        xlabel="E",
        ylabel="K",
    )
    axes.zaxis.set_major_locator(MaxNLocator(nbins=5))
    axes.tick_params(pad=-2, labelsize=min(6.5, 55 / len(E)))
    axes.view_init(elev=32, azim=-60)
    axes.set_box_aspect((1.5, 1.1, 0.9), zoom=1.12)
    axes.set_title(f"(a) {label}", loc="left")


def _cells(axes: Axes, E, K, values: np.ndarray, label: str, digits: int, norm: Normalize) -> None:
    mesh = axes.pcolormesh(
        np.arange(len(E) + 1) - 0.5,
        np.arange(len(K) + 1) - 0.5,
        np.ma.masked_invalid(values.T),
        cmap=HEIGHT_MAP,
        norm=norm,
        edgecolors="white",
        linewidth=0.8,
    )
    size = min(7.0, 60 / len(E))
    for (i, j), value in np.ndenumerate(values):
        text = "–" if np.isnan(value) else f"{value:.{digits}f}"
        on_dark = not np.isnan(value) and norm(value) < 0.6
        axes.text(i, j, text, ha="center", va="center", fontsize=size, color="white" if on_dark else "black")
    axes.set_title("(b)")
    axes.set_xticks(range(len(E)), [f"{e:g}" for e in E])
    axes.set_yticks(range(len(K)), [f"{k:g}" for k in K])
    axes.set(
        facecolor=MISSING, xlabel="Young modulus E (normalised)", ylabel="plastic modulus K (normalised)"
    )
    bar = axes.figure.colorbar(mesh, ax=axes, label=label, location="bottom", aspect=30)
    bar.locator = MaxNLocator(nbins=5)
