"""Verdicts on the claims in several studies: side by side, counted, and drawn as a mark for each."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.io.errors import BadInput
from bladerub.plots import style
from bladerub.study.findings.claim import SCORE

MARKS = {
    "yes": {"marker": "o", "facecolor": style.DARK, "edgecolor": style.DARK},
    "partly": {"marker": "o", "facecolor": style.ORANGE, "edgecolor": style.DARK},
    "no": {"marker": "x", "facecolor": style.GREY},
}
"""Full, light and crossed, so that grey print keeps them apart."""


def side_by_side(table: pd.DataFrame, by: str) -> pd.DataFrame:
    """Return ``holds`` of each claim (rows) by the values of the column `by` (columns), both in their order.

    `table` has the findings of several studies, or of several ways to judge one, which `by` distinguishes.
    Raises `BadInput` if it has none.
    """
    if table.empty:
        raise BadInput("no claim is judged: none is about the coatings and speeds that are varied")
    wide = table.pivot_table(index="id", columns=by, values="holds", aggfunc="first")
    return wide.loc[list(dict.fromkeys(table["id"])), list(dict.fromkeys(table[by]))]


def counts(table: pd.DataFrame) -> pd.DataFrame:
    """Count the verdicts of each ``set`` in a `table` of findings, and name those that differ from the first.

    A row a set: ``yes``, ``partly``, ``no``, and the claims that are ``better`` or ``worse``. A verdict that
    the one set has and the other does not is left out.
    """
    holds = side_by_side(table, by="set")
    numbers = holds.apply(pd.Series.value_counts).reindex(list(SCORE)).fillna(0).astype(int).T
    score = holds.apply(lambda of_set: of_set.map(SCORE))
    change = score.sub(score.iloc[:, 0], axis=0)
    for word, differs in (("better", change > 0), ("worse", change < 0)):
        numbers[word] = [" ".join(differs.index[differs[name]]) for name in holds]
    return numbers.rename_axis(index="set", columns=None).reset_index()


@style.styled
def verdicts(holds: pd.DataFrame) -> Figure:
    """Draw a column a study and a row a claim: `holds` is yes, partly, no or, without a verdict, NaN."""
    rows, columns = holds.shape
    figure = style.new_figure(style.PAGE, 0.9 + 0.155 * rows + 0.045 * max(map(len, holds.columns)))
    axes = figure.subplots()
    for word, mark in MARKS.items():
        claim, study = np.nonzero((holds == word).to_numpy())
        axes.scatter(study, claim, s=26, linewidth=0.8, label=word, zorder=2, **mark)
    axes.set_xticks(range(columns), holds.columns, rotation=90)
    axes.set_yticks(range(rows), holds.index)
    axes.set(xlim=(-0.7, columns - 0.3), ylim=(rows - 0.4, -0.6))
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.spines[:].set_visible(False)
    for row in range(rows):
        axes.axhline(row, color="#e9e9e9", linewidth=0.6, zorder=1)
    for column, count in enumerate((holds == "yes").sum()):
        axes.text(column, rows - 0.3, str(count), ha="center", va="top", fontsize=8)
    axes.text(-0.9, rows - 0.3, "yes", ha="right", va="top", fontsize=8)
    figure.legend(loc="outside lower center", ncols=3, handletextpad=0.2)
    return figure
