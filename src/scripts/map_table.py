"""Find the resonant peaks of every coating, or judge for every run whether it diverges."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.settings.study import typed
from bladerub.study import divergence, peaks
from bladerub.study.grid import modulus_unit
from bladerub.study.maps import read_map

TABLES = {  # what makes each, its column of speeds, and that of the same in rpm
    "peaks": (peaks.table, "f_peak", "f_peak_rpm"),
    "divergence": (divergence.table, "f_omega", "rpm"),
}

config = typed(snakemake.config)
make, speed, rpm = TABLES[Path(snakemake.output.table).stem]
table = make(config, map(read_map, snakemake.input.maps))
units = {"modulus_unit": modulus_unit(config), rpm: 60 * outputs.f1_hz(snakemake) * table[speed]}
outputs.save(snakemake, table=table.assign(**units))
