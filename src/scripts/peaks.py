"""Find the resonant peaks of every coating."""

from bladerub.study import peak_table
from bladerub.study.maps import read_map
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

maps = map(read_map, snakemake.input.maps)
outputs.save(snakemake, table=peak_table.table(snakemake.config, maps))
