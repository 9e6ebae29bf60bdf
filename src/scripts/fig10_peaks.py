"""Fig. 10: maxima Y_k, f_k on the spectrum, and the amplitude along their orders (m)."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.maps import peak_sections
from bladerub.settings.analysis import Peaks
from bladerub.study.maps import read_map

coating, settings = read_map(snakemake.input.map), Peaks(**snakemake.params.peaks)
look = snakemake.params.amplitude_range, snakemake.params.max_frequency
table, figure = peak_sections(coating, settings, *look, outputs.scales(snakemake))
outputs.save(snakemake, figure, data=table)
