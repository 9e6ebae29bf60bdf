"""Measure the error of drawn runs over their time steps."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.plots.steps import steps as draw
from bladerub.extras.verification.steps import table
from bladerub.settings.study import typed
from bladerub.workflow import outputs

blade = read_reduced_blade(snakemake.input.blade)
rows = table(blade, typed(snakemake.config), report=job.log)
outputs.save(snakemake, draw(rows), table=rows)
