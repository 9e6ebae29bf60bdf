"""Collect what the jobs of the study cost."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.cost.jobs import by_stage, cost, table

costs = table(snakemake.params.benchmarks, snakemake.params.added)
outputs.save(snakemake, cost(by_stage(costs)), table=costs)
