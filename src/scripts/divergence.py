"""Judge for every run whether it diverges."""

from bladerub.study import divergence
from bladerub.study.maps import read_map
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

maps = map(read_map, snakemake.input.maps)
outputs.save(snakemake, table=divergence.table(snakemake.config, maps))
