"""Simulate the passes of rub rigs, and set their last ones beside what was measured."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.plots.studies import rigs
from bladerub.extras.rig.passes import compared, table
from bladerub.extras.rig.spec import read_rigs

described = read_rigs(snakemake.input.rigs)
passes = table(described)
comparison = compared(described, passes)
outputs.save(snakemake, rigs(passes, comparison), data=passes, table=comparison)
