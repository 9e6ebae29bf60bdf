"""Compare points of the chart with the same coatings of the study."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.chart.table import agreement
from bladerub.io import tables

compared = agreement(tables.read(snakemake.input.chart), tables.read(snakemake.input.placement))
outputs.save(snakemake, table=compared)
