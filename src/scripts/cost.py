"""Gather what the jobs of the study cost."""

import sys

from bladerub.plots import style
from bladerub.plots.cost import cost
from bladerub.study.cost import by_stage, table

sys.stderr = open(snakemake.log[0], "w", buffering=1)

costs = table(snakemake.params.benchmarks)
costs.to_csv(snakemake.output.table, index=False)
style.save(cost(by_stage(costs)), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
