"""Judge for every run whether it diverges."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.study import divergence
from bladerub.workflow import job

job.log_to(snakemake.log[0])

table = divergence.table(snakemake.config, snakemake.input.maps)
tables.write(snakemake.output[0], table, provenance(snakemake.config))
