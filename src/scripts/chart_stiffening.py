"""Set the speeds of the peaks against the modulus of the contact."""

from bladerub import job, tablefile
from bladerub.blade.model import read_reduced_blade
from bladerub.plots import style
from bladerub.plots.chart_stiffening import chart_stiffening
from bladerub.provenance import provenance
from bladerub.study.chart.stiffening import table

job.log_to(snakemake.log[0])

peaks = tablefile.read(snakemake.input.peaks)
summary = table(peaks, read_reduced_blade(snakemake.input.blade))
tablefile.write(snakemake.output.table, summary, provenance(snakemake.config))
style.save(chart_stiffening(peaks, summary), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
