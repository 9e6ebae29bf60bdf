"""Compute the long runs of one coating."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.passages import long_runs
from bladerub.settings.study import typed
from bladerub.study.maps import read_map

config, inputs = typed(snakemake.config), snakemake.input
coating, blade = read_map(inputs.map), read_reduced_blade(inputs.blade)
long_runs.make(config, coating, blade, snakemake.output[0], report=job.log)
