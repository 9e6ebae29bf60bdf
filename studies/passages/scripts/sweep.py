"""Compute one speed sweep of one coating."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.passages import sweeps
from bladerub.settings.study import typed
from bladerub.study.grid import case_from_name

config, wildcards = typed(snakemake.config), snakemake.wildcards
case, blade = case_from_name(config, wildcards.coating), read_reduced_blade(snakemake.input.blade)
direction, rate = wildcards.direction, float(wildcards.rate)
job.log(sweeps.make(config, case, blade, direction, rate, snakemake.output[0]).message)
