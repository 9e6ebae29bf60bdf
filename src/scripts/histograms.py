"""Figs. 11 to 14: amplitude (m, drawn in mm) or speed of the peak on an engine order, over E and K."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.io import tables
from bladerub.plots.histogram import peak_histogram
from bladerub.study.peaks import COLUMNS
from bladerub.study.variants import plain

settings = snakemake.params
peaks = plain(tables.read(snakemake.input.peaks, COLUMNS)).query(settings.coatings)
for name, (quantity, order) in settings.figures.items():
    data, figure = peak_histogram(peaks, quantity, order, settings.modulus_unit)
    outputs.save(snakemake, figure, f"{name}_", data=data)
