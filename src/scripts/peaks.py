"""Find the resonant peaks of every coating."""

from bladerub.study import peaks
from bladerub.study.maps import read_map
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

maps = map(read_map, snakemake.input.maps)
outputs.save(snakemake, table=peaks.table(snakemake.config, maps))
