"""Run one coating of one set of Rotor 37 at all speeds, and measure it."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37.numbers import of_coating
from bladerub.extras.small_study import map_coating
from bladerub.io.provenance import provenance
from bladerub.settings.study import typed
from bladerub.study.cache import blade_digest
from bladerub.study.grid import case_from_name

config, model = typed(snakemake.params.config), snakemake.input.blade
case, blade = case_from_name(config, snakemake.wildcards.coating), read_reduced_blade(model)
coating, _ = map_coating(config, case, blade, blade_digest(model), snakemake.params.folder, report=job.log)
numbers = of_coating(config, coating, blade)
outputs.save(snakemake, origin=provenance(snakemake.params.config), numbers=numbers)
