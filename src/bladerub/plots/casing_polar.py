"""Initial inner shape of the casing, magnified."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from matplotlib.figure import Figure

from bladerub.plots.polar import close, open_polar
from bladerub.plots.style import BLUE, COLUMN, DARK, GREY, ORANGE, new_figure, styled

_LINES = (
    {"color": ORANGE, "linestyle": (0, (6, 2)), "linewidth": 1.4},
    {"color": BLUE, "linestyle": (0, (1.5, 1.2)), "linewidth": 1.4},
    {"color": DARK, "linestyle": "-", "linewidth": 2.0},
)


@styled
def casing_polar(
    angle: np.ndarray, inward: Mapping[str, np.ndarray], radius: float, magnification: float
) -> Figure:
    """Draw Fig. 5: the round casing and up to three distorted ones.

    Parameters
    ----------
    angle : (n,) array_like
        Casing angle, rad.
    inward : mapping of str to (n,) array_like
        Inward displacement of the inner surface by name of the shape, m.
    radius : float
        Radius of the round casing, m.
    magnification : float
        By how much the displacement is magnified.
    """
    figure = new_figure(COLUMN, 1.25 * COLUMN)
    largest = max(np.abs(u).max() for u in inward.values())
    axes = open_polar(figure, 1, 1, 1)
    axes.plot(*close(angle, np.full(np.size(angle), radius)), color=GREY, linewidth=1.0, label="round casing")
    for (name, displacement), line in zip(inward.items(), _LINES, strict=False):
        axes.plot(*close(angle, radius - magnification * np.asarray(displacement)), label=name, **line)
    rings = radius + magnification * largest * np.array([-1, 0, 1])
    axes.set_rgrids(rings, [])
    axes.set_rlim(0, radius + 1.1 * magnification * largest)
    figure.legend(
        loc="outside lower center",
        ncols=2,
        title=f"change of the inner radius ({1e3 * radius:.0f} mm), magnified {magnification:g} times\n"
        f"(rings {1e3 * largest:.2g} mm apart)",
    )
    return figure
