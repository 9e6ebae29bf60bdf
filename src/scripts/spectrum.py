"""Figs. 7, 8, 9, 15 and 16: spectrum over the speed on one coating; the data are its map in ``maps/``."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.maps import spectrum_map
from bladerub.study.maps import read_map

settings = snakemake.params
look = settings.amplitude_range, settings.max_frequency
figure = spectrum_map(read_map(snakemake.input.map), *look, outputs.scales(snakemake))
outputs.save(snakemake, figure)
