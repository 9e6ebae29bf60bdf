"""Fig. 2: Campbell diagram of the finite element model and of the reduced model, normalised by f1 at rest."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.accuracy import CAMPBELL_COLUMNS
from bladerub.io import hdf5, tables
from bladerub.plots.campbell import campbell

table = tables.read(snakemake.input.campbell, CAMPBELL_COLUMNS)
table[["f_fe", "f_rom"]] /= hdf5.read_attributes(snakemake.input.blade)["f1_hz"]
table = table.rename(columns={"f_fe": "f_fe_over_f1", "f_rom": "f_rom_over_f1"})
modes = table.pivot(index="f_omega", columns="mode")
frequencies = modes["f_fe_over_f1"], modes["f_rom_over_f1"]
figure = campbell(modes.index, *frequencies, range(1, 13), outputs.scales(snakemake))
outputs.save(snakemake, figure, data=table)
