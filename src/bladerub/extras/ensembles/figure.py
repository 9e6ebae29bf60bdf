"""The maps of Figs. 11 to 14 with the bands of the peaks."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from bladerub.plots import titles
from bladerub.plots.histogram import Heights, draw_map
from bladerub.plots.style import PAGE, new_figure, styled
from bladerub.study.paper import ORDERS

_SCALE = {"amplitude": 1e3, "f_peak": 1.0}  # amplitudes are drawn in mm
_HATCH = {"fill": False, "edgecolor": "white", "linewidth": 0, "hatch": "////", "alpha": 0.45}


@styled
def peak_bands(peaks: pd.DataFrame, unit: float) -> Figure:
    """Draw Y_k and f_k over (E, K) of one casing and θ, each with half its band where its digits show it."""
    figure = new_figure(PAGE, 0.98 * PAGE)
    for row, order in zip(figure.subplots(len(ORDERS), 2), ORDERS, strict=True):
        for axes, (quantity, scale) in zip(row, _SCALE.items(), strict=True):
            heights = Heights.of(peaks, quantity, order)
            draw_map(axes, heights)
            width = scale * (peaks[f"{quantity}_high"] - peaks[f"{quantity}_low"])
            of_order = peaks.assign(half=width / 2)[peaks.order == order]
            half = of_order.pivot(index="E", columns="K", values="half").to_numpy()
            for text, band in zip(axes.texts, half.flat, strict=True):
                if band >= 0.5 * 10**-heights.digits:
                    text.set_text(f"{text.get_text()}\n±{band:.{heights.digits}f}")
            limit = 0.1 * heights.values.to_numpy() if quantity == "amplitude" else 0.01
            for i, j in np.argwhere(half > limit):
                axes.add_patch(Rectangle((i - 0.5, j - 0.5), 1, 1, **_HATCH))
            axes.set(**titles.moduli_axes(unit))
    figure.suptitle("± 90 % band; hatched above 10 % of Y and 0.01 of f", fontsize="medium")
    return figure
