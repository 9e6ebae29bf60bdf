"""Compute the direct contact of Rotor 37 by an integrator of its own, or by NLstep, and say which."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.rotor37 import direct, nlstep
from bladerub.io.provenance import PREFIX, provenance
from bladerub.settings.study import typed

plain, blade = snakemake.params.config, read_reduced_blade(snakemake.input.blade)
config, origin = typed(plain), provenance(plain)
if program := snakemake.input.get("program"):
    numbers = nlstep.table(config, blade, Path(program), snakemake.threads)
    origin[f"{PREFIX}program"] = nlstep.describe(Path(program))
else:
    numbers = direct.independent(config, blade)
outputs.save(snakemake, origin=origin, digits="%.7g", table=numbers)
