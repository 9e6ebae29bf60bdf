"""Collect what the jobs of the study cost, and what they would on more cores."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.plots.cost import cost
from bladerub.workflow import outputs, schedule
from bladerub.workflow.cost import by_stage, table

costs = table(snakemake.params.benchmarks, snakemake.params.added)
outputs.save(snakemake, cost(by_stage(costs)), table=costs, schedule=schedule.table(costs, snakemake.config))
