"""Simulate one run with a coating that heat softens, by how it conducts and how much heat it takes."""

from bladerub.blade.model import read_reduced_blade
from bladerub.extensions.heat import table
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

outputs.save(snakemake, table=table(snakemake.config, read_reduced_blade(snakemake.input.blade)))
