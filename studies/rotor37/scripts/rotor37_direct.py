"""Measure blade and direct contact of one set of Rotor 37."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37 import direct
from bladerub.extras.rotor37.numbers import of_blade
from bladerub.io import tables
from bladerub.io.provenance import provenance

config, blade = snakemake.params.config, read_reduced_blade(snakemake.input.blade)
results, origin = direct.runs(config, blade), provenance(snakemake.params.config)
tables.write(snakemake.output.blade, of_blade(config, blade), origin)
tables.write(snakemake.output.direct, direct.numbers(results), origin)
tables.write(snakemake.output.history, direct.last_revolution(results), origin)
