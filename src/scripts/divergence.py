"""Judge for every run whether it diverges."""

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study import divergence

job.log_to(snakemake.log[0])

table = divergence.table(snakemake.config, snakemake.input.maps)
tablefile.write(snakemake.output[0], table, provenance(snakemake.config))
