"""Compute one case of the direct contact of Rotor 37 by NLstep."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37.nlstep import table
from bladerub.io import tables
from bladerub.io.provenance import provenance

config, wildcards = snakemake.params.config, snakemake.wildcards
numbers = table(
    config,
    read_reduced_blade(snakemake.input.blade),
    Path(snakemake.input.program),
    float(wildcards.friction),
    int(wildcards.modes),
    int(wildcards.steps),
)
tables.write(snakemake.output.table, numbers, provenance(config), "%.7g")
