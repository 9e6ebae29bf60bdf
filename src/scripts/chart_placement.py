"""Put the search of the chart to the maps of the study, which knows every speed."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study.chart.check import summary, table

job.log_to(snakemake.log[0])

compared, origin = table(snakemake.config, snakemake.input.maps), provenance(snakemake.config)
tablefile.write(snakemake.output[0], compared, origin)
tablefile.write(snakemake.output.summary, summary(compared), origin)
