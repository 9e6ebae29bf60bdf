"""Find the ridges of the chart, and how surely they are known."""

from bladerub.extensions.chart.ridge import summary, table
from bladerub.extensions.chart.table import read_points
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.workflow import job

job.log_to(snakemake.log[0])

ridges, origin = table(snakemake.config, read_points(snakemake.input.manifests)), provenance(snakemake.config)
tables.write(snakemake.output[0], ridges, origin)
tables.write(snakemake.output.summary, summary(ridges), origin)
