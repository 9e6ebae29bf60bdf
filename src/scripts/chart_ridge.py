"""Find the ridges of the chart, and how surely they are known."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study.chart.ridge import summary, table
from bladerub.study.chart.table import read_cells

job.log_to(snakemake.log[0])

ridges, origin = table(snakemake.config, read_cells(snakemake.input.manifests)), provenance(snakemake.config)
tablefile.write(snakemake.output[0], ridges, origin)
tablefile.write(snakemake.output.summary, summary(ridges), origin)
