"""Find the resonant peaks of every coating, with their bands."""

from bladerub.study import bands, ensemble
from bladerub.study.maps import read_map
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

maps, ensembles = map(read_map, snakemake.input.maps), map(ensemble.read, snakemake.input.ensembles)
outputs.save(snakemake, table=bands.of_peaks(snakemake.config, list(maps), list(ensembles)))
