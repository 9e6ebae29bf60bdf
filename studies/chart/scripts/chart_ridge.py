"""Find the ridges of the chart, and how surely they are known."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.chart.ridge import summary, table
from bladerub.extras.chart.table import read_points
from bladerub.workflow import outputs

ridges = table(snakemake.config, read_points(snakemake.input.manifests))
outputs.save(snakemake, table=ridges, summary=summary(ridges))
