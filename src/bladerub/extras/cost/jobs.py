"""What a study costs: the records that Snakemake keeps of its jobs, a row a job, and their figure."""

import logging
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from bladerub.io import tables
from bladerub.io.errors import DamagedFile
from bladerub.plots import style

_log = logging.getLogger(__name__)

STAGES = {"blade": "blade", "compile_kernel": "compilation", "coating": "rubs"}
STAGES |= dict.fromkeys(("peaks", "divergence", "findings", "margins"), "tables")
STAGES |= dict.fromkeys(("casing", "histograms", "histories", "spectrum", "wear_map"), "figures")
"""Stage of each rule, in the order of the workflow; rules named after a figure of the paper: ``figures``."""
_RECORDED = ["s", "cpu_time", "max_rss"]
COLUMNS = ["stage", "rule", "job", "wall_s", "cpu_s", "memory_mb"]


def table(benchmarks: str | Path, others: Iterable[str] = ()) -> pd.DataFrame:
    """Collect the last record of each job, ``<rule>.tsv`` or ``<rule>/<job>.tsv``, of these and `others`."""
    rows, stage_of = [], {rule: rule for rule in others} | STAGES
    for path in sorted(Path(benchmarks).rglob("*.tsv")):
        *rule, name = path.relative_to(benchmarks).with_suffix("").parts
        rule, job = (rule[0], name) if rule else (name, "")
        if rule in stage_of or rule.startswith("fig"):
            try:
                last = tables.read(path, _RECORDED, separator="\t")[_RECORDED].tail(1)
            except DamagedFile as error:  # Snakemake was stopped while it wrote: no job is worth doing again
                _log.warning("left out: %s", error)
                continue
            figures = last.apply(pd.to_numeric, errors="coerce").itertuples(index=False)
            rows += [(stage_of.get(rule, "figures"), rule, job, *record) for record in figures]
    return pd.DataFrame(rows, columns=COLUMNS)


def by_stage(costs: pd.DataFrame) -> pd.DataFrame:
    """Sum up the jobs of `table` by stage, in the order of the workflow, and their share of the time."""
    grouped = costs.groupby("stage").agg(
        jobs=("rule", "size"), cpu_s=("cpu_s", "sum"), memory_mb=("memory_mb", "max")
    )
    order = dict.fromkeys([*STAGES.values(), *grouped.index])  # those of other rules at the end
    stages = grouped.loc[[stage for stage in order if stage in grouped.index]]
    stages.insert(2, "share", stages["cpu_s"] / stages["cpu_s"].sum())
    return stages


@style.styled
def cost(stages: pd.DataFrame) -> Figure:
    """Draw processor time, and memory of the largest job, a bar a stage, from `by_stage`."""
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
