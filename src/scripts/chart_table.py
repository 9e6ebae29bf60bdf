"""Sum up every cell of the chart."""

from bladerub.extensions.chart.table import read_points, table
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.workflow import job

job.log_to(snakemake.log[0])

chart = table(snakemake.config, read_points(snakemake.input.manifests))
tables.write(snakemake.output[0], chart, provenance(snakemake.config))
