"""Fig. 2: Campbell diagram of the finite element model and of the reduced model, normalised by f1 at rest."""

import sys

import pandas as pd

from bladerub import datafile
from bladerub.plots import style
from bladerub.plots.campbell import campbell

sys.stderr = open(snakemake.log[0], "w", buffering=1)

f1_hz = datafile.read_attributes(snakemake.input.blade)["f1_hz"]
table = pd.read_csv(snakemake.input.campbell)
table[["f_fe", "f_rom"]] /= f1_hz
table.to_csv(snakemake.output.data, index=False, float_format="%.6g")

modes = table.pivot(index="f_omega", columns="mode")
figure = campbell(modes.index, modes["f_fe"], modes["f_rom"], orders=range(1, 13))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
