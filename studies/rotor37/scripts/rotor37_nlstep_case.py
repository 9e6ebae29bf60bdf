"""Compute one case of the direct contact of Rotor 37 by NLstep."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37.nlstep import table
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed
from bladerub.workflow import outputs

config, wildcards = snakemake.params.config, snakemake.wildcards
numbers = table(
    typed(config),
    read_reduced_blade(snakemake.input.blade),
    Path(snakemake.input.program),
    float(wildcards.friction),
    int(wildcards.modes),
    int(wildcards.steps),
)
outputs.save(snakemake, origin=provenance(config), digits="%.7g", table=numbers)
