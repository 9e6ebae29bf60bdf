"""Fig. 13: amplitude Y6 of the maximum on engine order 6 over E and K, in m (drawn in mm)."""

import sys

import pandas as pd

from bladerub import tablefile
from bladerub.plots import style
from bladerub.plots.histogram import peak_amplitudes
from bladerub.provenance import provenance

sys.stderr = open(snakemake.log[0], "w", buffering=1)

peaks = pd.read_csv(snakemake.input.peaks).query(snakemake.params.coatings)
table, figure = peak_amplitudes(peaks, order=6)
tablefile.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
