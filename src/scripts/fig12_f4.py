"""Fig. 12: rotational frequency f4 of the maximum on engine order 4, over E and K."""

import sys

import pandas as pd

from bladerub.plots import style
from bladerub.plots.histogram import peak_speeds

sys.stderr = open(snakemake.log[0], "w", buffering=1)

peaks = pd.read_csv(snakemake.input.peaks).query(snakemake.params.coatings)
table, figure = peak_speeds(peaks, order=4)
table.to_csv(snakemake.output.data, float_format="%.6g")
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
