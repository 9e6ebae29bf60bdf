"""Find the resonant peaks of every coating."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.settings.study import typed
from bladerub.study import peak_table
from bladerub.study.grid import modulus_unit
from bladerub.study.maps import read_map
from bladerub.workflow import outputs

config = typed(snakemake.config)
table = peak_table.table(config, map(read_map, snakemake.input.maps))
units = {"modulus_unit": modulus_unit(config), "f_peak_rpm": outputs.rpm(snakemake, table.f_peak)}
outputs.save(snakemake, table=table.assign(**units))
