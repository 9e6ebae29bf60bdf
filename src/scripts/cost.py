"""Collect what the jobs of the study cost."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots.cost import cost
from bladerub.workflow import job, outputs, schedule
from bladerub.workflow.cost import by_stage, table

job.log_to(snakemake.log[0])

costs = table(snakemake.params.benchmarks)
on_cores = schedule.table(costs, snakemake.config)
tables.write(snakemake.output.schedule, on_cores, provenance(snakemake.config))
outputs.save(snakemake, cost(by_stage(costs)), table=costs)
