"""Collect what the jobs of the study cost."""

from bladerub.plots.cost import cost
from bladerub.workflow import job, outputs
from bladerub.workflow.cost import by_stage, table

job.log_to(snakemake.log[0])

costs = table(snakemake.params.benchmarks)
outputs.save(snakemake, cost(by_stage(costs)), table=costs)
