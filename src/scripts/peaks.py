"""Find the resonant peaks of every coating."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.study import peaks
from bladerub.workflow import job

job.log_to(snakemake.log[0])

table = peaks.table(snakemake.config, snakemake.input.maps)
tables.write(snakemake.output[0], table, provenance(snakemake.config))
