"""Set the speeds of the peaks against the modulus of the contact."""

from bladerub.blade.model import read_reduced_blade
from bladerub.extensions.chart.stiffening import table
from bladerub.extensions.plots.chart_stiffening import chart_stiffening
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.workflow import job

job.log_to(snakemake.log[0])

peaks = tables.read(snakemake.input.peaks)
summary = table(peaks, read_reduced_blade(snakemake.input.blade))
tables.write(snakemake.output.table, summary, provenance(snakemake.config))
style.save(chart_stiffening(peaks, summary), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
