"""Find the resonant peaks of every coating."""

from bladerub.study import peaks
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

outputs.save(snakemake, table=peaks.table(snakemake.config, snakemake.input.maps))
