"""Compare the cells of the chart with the coatings of the study that they are."""

from bladerub.extensions.chart.check import agreement
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.workflow import job

job.log_to(snakemake.log[0])

compared = agreement(tables.read(snakemake.input.chart), tables.read(snakemake.input.placement))
tables.write(snakemake.output[0], compared, provenance(snakemake.config))
