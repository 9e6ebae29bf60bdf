"""Relate the speeds of the peaks to the modulus of the contact."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.chart.stiffening import table
from bladerub.extras.plots.chart_peaks import chart_stiffening
from bladerub.io import tables
from bladerub.workflow import outputs

peaks = tables.read(snakemake.input.peaks)
summary = table(peaks, read_reduced_blade(snakemake.input.blade))
outputs.save(snakemake, chart_stiffening(peaks, summary, snakemake.params.modulus_unit), table=summary)
