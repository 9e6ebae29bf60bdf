"""Fig. 2: Campbell diagram of the finite element model and of the reduced model, normalised by f1 at rest."""

import sys

import pandas as pd

from bladerub import datafile, tablefile
from bladerub.plots import style
from bladerub.plots.campbell import campbell
from bladerub.provenance import provenance

sys.stderr = open(snakemake.log[0], "w", buffering=1)

f1_hz = datafile.read_attributes(snakemake.input.blade)["f1_hz"]
table = pd.read_csv(snakemake.input.campbell)
table[["f_fe", "f_rom"]] /= f1_hz
table = table.rename(columns={"f_fe": "f_fe_over_f1", "f_rom": "f_rom_over_f1"})
tablefile.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")

modes = table.pivot(index="f_omega", columns="mode")
figure = campbell(modes.index, modes["f_fe_over_f1"], modes["f_rom_over_f1"], orders=range(1, 13))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
