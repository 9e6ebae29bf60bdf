"""Fig. 14: rotational frequency f6 of the maximum on engine order 6, over E and K."""

import sys

import pandas as pd

from bladerub.plots import style
from bladerub.plots.histogram import histogram

sys.stderr = open(snakemake.log[0], "w", buffering=1)

peaks = pd.read_csv(snakemake.input.peaks).query(snakemake.params.coatings + " and order == 6")
table = peaks.pivot(index="E", columns="K", values="f_peak")
table.to_csv(snakemake.output.data, float_format="%.6g")
floor = table.min(axis=None) - 0.01  # so that the lowest bar is seen, and the differences too
figure = histogram(
    table.index,
    table.columns,
    table.to_numpy(),
    "rotational frequency $f_6$ (normalised)",
    digits=3,
    floor=floor,
)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
