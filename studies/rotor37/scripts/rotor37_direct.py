"""Measure blade and direct contact of one set of Rotor 37."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37 import direct
from bladerub.extras.rotor37.numbers import of_blade
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed

config, blade = typed(snakemake.params.config), read_reduced_blade(snakemake.input.blade)
results, origin = direct.runs(config, blade), provenance(snakemake.params.config)
of_runs = {"direct": direct.numbers(results), "history": direct.last_revolution(results)}
outputs.save(snakemake, origin=origin, blade=of_blade(config, blade), **of_runs)
