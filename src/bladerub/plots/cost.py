"""What each stage of a study costs: time of the processor, and memory of its largest job."""

from __future__ import annotations

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.plots import style


@style.styled
def cost(stages: pd.DataFrame) -> Figure:
    """Draw processor time and memory, a bar a stage.

    Parameters
    ----------
    stages : DataFrame
        From `bladerub.workflow.cost.by_stage`.
    """
    figure = style.new_figure(style.PAGE, 0.34 * style.PAGE)
    time, memory = figure.subplots(1, 2, sharey=True, width_ratios=[3, 2])
    place = np.arange(len(stages))
    minutes = stages["cpu_s"] / 60
    bars = time.barh(place, minutes, color=style.DARK, height=0.62)
    time.bar_label(bars, [_words(row) for row in stages.itertuples()], padding=4, fontsize=8)
    time.set_yticks(place, stages.index)
    time.invert_yaxis()
    time.set_xlim(0, 1.45 * minutes.max())
    time.set_xlabel("processor time (min)")
    time.set_title(f"{minutes.sum():.1f} min of processor time")
    bars = memory.barh(place, stages["memory_mb"], color=style.ORANGE, height=0.62)
    memory.bar_label(bars, [f"{value:.0f}" for value in stages["memory_mb"]], padding=4, fontsize=8)
    memory.tick_params(axis="y", left=False)
    memory.set_xlim(0, 1.2 * stages["memory_mb"].max())
    memory.set_xlabel("memory of the largest job (MB)")
    return figure


def _words(row) -> str:
    jobs = "1 job" if row.jobs == 1 else f"{row.jobs} jobs"
    return f"{row.share:.1%}, {jobs}"
