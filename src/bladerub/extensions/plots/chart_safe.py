"""Which coatings of the chart keep the limits, and which limits the others exceed."""

from collections.abc import Mapping

import pandas as pd
from matplotlib.colors import ListedColormap
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from bladerub.extensions.plots.chart_panel import colour, mark_paper, over_moduli, panels
from bladerub.plots.style import DARK, PAGE, new_figure, styled

LETTERS = {"amplitude": "A", "wear": "W", "divergent_share": "D"}
"""Letter of each limit, written where it is exceeded."""
_SHADES = ["#ffffff", "#f3d9a4", "#e08e0b", "#8f4b08"]
"""From none to all limits exceeded."""


@styled
def chart_safe(chart: pd.DataFrame, broken: pd.DataFrame, limits: Mapping[str, float]) -> Figure:
    """Draw for each θ which coatings of ``chart.csv`` exceed which of the `limits`.

    `broken` is for the same rows, from `bladerub.extensions.chart.choice.broken_limits`.
    """
    judged = chart.assign(
        broken=broken.sum(axis=1),
        letters=["".join(LETTERS[name] for name in LETTERS if row[name]) for _, row in broken.iterrows()],
    )
    figure = new_figure(PAGE, 0.55 * PAGE)
    for axes, rows in panels(figure, judged):
        grid, colours = over_moduli(rows, "broken"), ListedColormap(_SHADES)
        colour(axes, grid, cmap=colours, vmin=-0.5, vmax=len(_SHADES) - 0.5, edgecolors="white", lw=0.2)
        size = min(7.0, 75 / max(grid.values.shape))
        for row in rows.itertuples():
            shade = "white" if row.broken == len(LETTERS) else DARK
            axes.text(row.E, row.K, row.letters, ha="center", va="center", fontsize=size, color=shade)
        mark_paper(axes, rows[rows.broken == 0])
    figure.legend(handles=_keys(limits), loc="outside lower center", ncols=2)
    return figure


def _keys(limits: Mapping[str, float]) -> list[Patch]:
    words = {
        "amplitude": f"A: displacement above {1e3 * limits['amplitude']:g} mm",
        "wear": f"W: wear deeper than {1e3 * limits['wear']:g} mm",
        "divergent_share": f"D: more than {100 * limits['divergent_share']:g} % of the speeds diverge",
    }
    safe = Patch(facecolor=_SHADES[0], edgecolor=DARK, linewidth=0.5, label="all limits kept")
    return [safe, *(Patch(facecolor="none", label=text) for text in words.values())]
