"""Find the resonant peaks of every coating, with their bands."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.study import bands, ensemble
from bladerub.study.maps import read_map
from bladerub.workflow import outputs

maps, ensembles = map(read_map, snakemake.input.maps), map(ensemble.read, snakemake.input.ensembles)
table = bands.of_peaks(snakemake.config, list(maps), list(ensembles))
outputs.save(snakemake, table=table.assign(f_peak_rpm=outputs.rpm(snakemake, table.f_peak)))
