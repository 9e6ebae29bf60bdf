"""Compute the direct contact of Rotor 37 by an integrator of its own."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37.direct import independent
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed

config = snakemake.params.config
numbers = independent(typed(config), read_reduced_blade(snakemake.input.blade))
outputs.save(snakemake, origin=provenance(config), digits="%.7g", table=numbers)
