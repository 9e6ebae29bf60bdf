"""Fig. 11: amplitude Y4 of the maximum on engine order 4 over E and K, in m (drawn in mm)."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.histogram import peak_amplitudes
from bladerub.study.peaks import COLUMNS
from bladerub.workflow import job

job.log_to(snakemake.log[0])

peaks = tables.read(snakemake.input.peaks, COLUMNS).query(snakemake.params.coatings)
table, figure = peak_amplitudes(peaks, order=4)
tables.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
