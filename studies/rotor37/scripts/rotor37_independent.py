"""Compute the direct contact of Rotor 37 by an integrator of its own."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37.independent import table
from bladerub.io import tables
from bladerub.io.provenance import provenance

config = snakemake.params.config
numbers = table(config, read_reduced_blade(snakemake.input.blade))
tables.write(snakemake.output.table, numbers, provenance(config), "%.7g")
