"""Gather what the jobs of the study cost."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.cost import cost
from bladerub.provenance import provenance
from bladerub.study.cost import by_stage, table

job.log_to(snakemake.log[0])

costs = table(snakemake.params.benchmarks)
tablefile.write(snakemake.output.table, costs, provenance(snakemake.config))
style.save(cost(by_stage(costs)), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
