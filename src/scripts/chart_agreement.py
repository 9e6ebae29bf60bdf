"""Compare the cells of the chart with the coatings of the study that they are."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study.chart.check import agreement

job.log_to(snakemake.log[0])

compared = agreement(tablefile.read(snakemake.input.chart), tablefile.read(snakemake.input.placement))
tablefile.write(snakemake.output[0], compared, provenance(snakemake.config))
