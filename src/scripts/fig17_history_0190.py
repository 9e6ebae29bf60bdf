"""Fig. 17: radial displacement of node 1 (m) at f_Ω = 0.190, straight and inclined coating elements."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.history import history_of_runs
from bladerub.workflow import job

job.log_to(snakemake.log[0])

table, figure = history_of_runs(snakemake.params.runs)
tables.write(snakemake.output.data, table, provenance(snakemake.config), "%.6g")
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
