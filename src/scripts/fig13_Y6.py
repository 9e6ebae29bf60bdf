"""Fig. 13: amplitude Y6 of the maximum on engine order 6 over E and K, in m (drawn in mm)."""

import sys

import pandas as pd

from bladerub.plots import style
from bladerub.plots.histogram import histogram

sys.stderr = open(snakemake.log[0], "w", buffering=1)

peaks = pd.read_csv(snakemake.input.peaks).query(snakemake.params.coatings + " and order == 6")
table = peaks.pivot(index="E", columns="K", values="amplitude")
table.to_csv(snakemake.output.data, float_format="%.6g")
figure = histogram(table.index, table.columns, 1e3 * table.to_numpy(), "$Y_6$ (mm)", digits=3)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
