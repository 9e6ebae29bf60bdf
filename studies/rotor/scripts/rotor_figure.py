"""A figure of the rows of blades: of all combinations, or of those that are swept."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.extras.plots import rotor
from bladerub.extras.rotor.plan import read_plan
from bladerub.io import tables
from bladerub.settings.study import typed

draw = {"rotor": rotor.rotor, "rotor_sweeps": rotor.rotor_sweeps}[Path(snakemake.output.png).stem]
plan = read_plan(snakemake.input.plan, typed(snakemake.config))
outputs.save(snakemake, draw(plan, tables.read(snakemake.input.table)))
