"""Compute the direct contact of Rotor 37 by NLstep, and say which NLstep it was."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37 import nlstep
from bladerub.io.provenance import PREFIX, provenance
from bladerub.settings.study import typed

config, function = snakemake.params.config, Path(snakemake.input.program)
blade = read_reduced_blade(snakemake.input.blade)
numbers = nlstep.table(typed(config), blade, function, snakemake.threads)
origin = provenance(config) | {f"{PREFIX}program": nlstep.describe(function)}
outputs.save(snakemake, origin=origin, digits="%.7g", table=numbers)
