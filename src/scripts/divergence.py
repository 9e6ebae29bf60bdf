"""Judge for every run whether it diverges."""

from bladerub.study import divergence
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

outputs.save(snakemake, table=divergence.table(snakemake.config, snakemake.input.maps))
