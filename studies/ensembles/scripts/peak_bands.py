"""Amplitude and speed of the peaks over E and K, with their bands."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.ensembles.bands import PEAK_COLUMNS
from bladerub.extras.ensembles.figure import peak_bands
from bladerub.io import tables
from bladerub.study.peaks import COLUMNS
from bladerub.study.variants import plain

peaks = plain(tables.read(snakemake.input.peaks, [*COLUMNS, *PEAK_COLUMNS])).query(snakemake.params.coatings)
outputs.save(snakemake, peak_bands(peaks, snakemake.params.modulus_unit))
