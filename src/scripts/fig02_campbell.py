"""Fig. 2: Campbell diagram of the finite element model and of the reduced model, normalised by f1 at rest."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.frequencies import CAMPBELL_COLUMNS
from bladerub.io import tables
from bladerub.plots.campbell import campbell

table, scales = tables.read(snakemake.input.campbell, CAMPBELL_COLUMNS), outputs.scales(snakemake)
figure = campbell(table, scales)
table[["f_fe", "f_rom"]] /= scales.f1_hz
table = table.rename(columns={"f_fe": "f_fe_over_f1", "f_rom": "f_rom_over_f1"})
outputs.save(snakemake, figure, data=table)
