"""Compute one case of the direct contact of Rotor 37 by NLstep."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37.nlstep import table
from bladerub.io import tables
from bladerub.io.provenance import provenance

config, given = snakemake.params.config, snakemake.wildcards
found = table(
    config,
    read_reduced_blade(snakemake.input.blade),
    Path(snakemake.input.program),
    float(given.friction),
    int(given.modes),
    int(given.steps),
)
tables.write(snakemake.output.table, found, provenance(config), "%.7g")
