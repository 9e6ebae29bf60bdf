"""Find the resonant peaks of every coating."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study import peaks

job.log_to(snakemake.log[0])

table = peaks.table(snakemake.config, snakemake.input.maps)
tablefile.write(snakemake.output[0], table, provenance(snakemake.config))
