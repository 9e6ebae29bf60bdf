"""What each stage of a study costs: processor time, and memory of its largest job."""

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.plots import style


@style.styled
def cost(stages: pd.DataFrame) -> Figure:
    """Draw processor time and memory, a bar a stage, from `bladerub.extras.cost.jobs.by_stage`."""
    figure = style.new_figure(style.PAGE, 0.34 * style.PAGE)
    time, memory = figure.subplots(1, 2, sharey=True, width_ratios=[3, 2])
    place, minutes = np.arange(len(stages)), stages["cpu_s"] / 60
    shares = [
        f"{stage.share:.1%}, {stage.jobs} job{'' if stage.jobs == 1 else 's'}"
        for stage in stages.itertuples()
    ]
    time.bar_label(time.barh(place, minutes, color=style.DARK, height=0.62), shares, padding=4, fontsize=8)
    time.set_yticks(place, stages.index)
    time.invert_yaxis()
    time.set(xlim=(0, 1.45 * minutes.max()), xlabel="processor time (min)")
    time.set_title(f"{minutes.sum():.1f} min of processor time")
    bars = memory.barh(place, stages["memory_mb"], color=style.ORANGE, height=0.62)
    memory.bar_label(bars, [f"{value:.0f}" for value in stages["memory_mb"]], padding=4, fontsize=8)
    memory.tick_params(axis="y", left=False)
    memory.set(xlim=(0, 1.2 * stages["memory_mb"].max()), xlabel="memory of the largest job (MB)")
    return figure
