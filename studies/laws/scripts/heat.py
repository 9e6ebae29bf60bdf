"""Simulate one run with a coating that heat softens, by how it conducts and how much heat it takes."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.heat import table
from bladerub.settings.study import typed

outputs.save(snakemake, table=table(typed(snakemake.config), read_reduced_blade(snakemake.input.blade)))
