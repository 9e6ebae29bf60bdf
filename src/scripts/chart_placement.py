"""Put the search of the chart to the maps of the study, which knows every speed."""

from bladerub.extensions.chart.check import summary, table
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.study.maps import read_map
from bladerub.workflow import job

job.log_to(snakemake.log[0])

compared, origin = table(snakemake.config, map(read_map, snakemake.input.maps)), provenance(snakemake.config)
tables.write(snakemake.output[0], compared, origin)
tables.write(snakemake.output.summary, summary(compared), origin)
