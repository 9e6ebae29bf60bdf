"""Sum up every cell of the chart."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study.chart.table import read_cells, table

job.log_to(snakemake.log[0])

chart = table(snakemake.config, read_cells(snakemake.input.manifests))
tablefile.write(snakemake.output[0], chart, provenance(snakemake.config))
