"""Find the bands of the peaks of every coating, and of the runs that have an ensemble."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.ensembles import bands, ensemble
from bladerub.settings.study import typed
from bladerub.study.maps import read_map
from bladerub.workflow import outputs

config, maps = typed(snakemake.config), [read_map(path) for path in snakemake.input.maps]
ensembles = [ensemble.read(path) for path in snakemake.input.ensembles]
peaks = bands.of_peaks(config, maps, ensembles)
outputs.save(snakemake, peaks=peaks, runs=bands.of_runs(config, maps, ensembles))
