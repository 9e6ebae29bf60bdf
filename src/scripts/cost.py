"""Gather what the jobs of the study cost."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.cost import cost
from bladerub.workflow import job
from bladerub.workflow.cost import by_stage, table

job.log_to(snakemake.log[0])

costs = table(snakemake.params.benchmarks)
tables.write(snakemake.output.table, costs, provenance(snakemake.config))
style.save(cost(by_stage(costs)), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
