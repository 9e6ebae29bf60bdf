"""Radial displacement of node 1 (m) as in Figs. 17 and 18, at a speed of our own."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.history import history_of_runs
from bladerub.provenance import provenance

job.log_to(snakemake.log[0])

table, figure = history_of_runs(snakemake.params.runs)
tablefile.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
