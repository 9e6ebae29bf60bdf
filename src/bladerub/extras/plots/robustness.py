"""How far the claims depend on what the paper leaves open: shares of the design, and what decides."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.extras.robustness.summary import DECIDES, VERDICT
from bladerub.plots import style

SHARES = {"yes": style.DARK, "partly": style.ORANGE, "no": style.MISSING}
"""Dark, middle and light, so that they can be distinguished in grey print."""


@style.styled
def robustness(table: pd.DataFrame, indices: pd.DataFrame) -> Figure:
    """Draw a row for each claim: the shares of the design on the left, the factors on the right.

    `table` and `indices` are those of `bladerub.extras.robustness.summary`.
    """
    figure = style.new_figure(style.PAGE, 1.6 + 0.155 * len(table))
    shares, factors = figure.subplots(1, 2, sharey=True, width_ratios=(1, 1.5))
    _draw_shares(shares, table)
    image = _draw_factors(factors, table, indices)
    bar = figure.colorbar(image, ax=factors, shrink=0.35, anchor=(0, 1), label="total index of the verdict")
    bar.outline.set_visible(False)
    figure.legend(loc="outside lower left", ncols=len(SHARES))
    return figure


def _draw_shares(axes, table: pd.DataFrame) -> None:
    rows, start = np.arange(len(table)), np.zeros(len(table))
    for word, colour in SHARES.items():
        share = 100 * table[f"{word}_share"].to_numpy()
        axes.barh(rows, share, left=start, height=0.72, label=word, color=colour)
        start += share
    axes.set_yticks(rows, table.id)
    axes.set_ylim(len(table) - 0.4, -0.6)
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of the design (%)")
    axes.tick_params(axis="y", length=0)
    axes.spines[:].set_visible(False)


def _draw_factors(axes, table: pd.DataFrame, indices: pd.DataFrame):
    of_verdict = indices[indices.output == VERDICT]
    factors = list(dict.fromkeys(indices.factor))
    total = of_verdict.pivot(index="id", columns="factor", values="total")
    total = total.reindex(index=table.id, columns=factors).astype(float)
    scale = np.fmax(DECIDES, total.max(axis=None))  # often small, because there are many factors
    columns, rows = np.arange(len(factors) + 1) - 0.5, np.arange(len(table) + 1) - 0.5
    image = axes.pcolormesh(columns, rows, total, cmap=style.WEAR_MAP, vmin=0, vmax=scale)
    for row, column in np.argwhere(total.to_numpy() >= DECIDES):
        value = total.iat[row, column]
        colour = "white" if value > scale / 2 else style.DARK
        axes.text(column, row, f"{value:.1f}", ha="center", va="center", fontsize=6, color=colour)
    for row, predicted in enumerate(table.predicted):
        axes.axhline(row - 0.5, color="white", linewidth=0.6)
        if np.isfinite(predicted):
            axes.text(len(factors) - 0.3, row, f"{predicted:.2f}", va="center", fontsize=6)
    axes.set_facecolor(style.MISSING)
    axes.text(len(factors) - 0.3, len(table) - 0.2, "predicted", rotation=90, va="top", fontsize=8)
    axes.set_xticks(range(len(factors)), factors, rotation=90)
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    return image
