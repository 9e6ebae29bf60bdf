"""Tables and figure of the rows of blades."""

from bladerub.extensions.plots.rotor import rotor as draw
from bladerub.extensions.rotor import summary
from bladerub.extensions.rotor.plan import read_plan
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

plan = read_plan(snakemake.input.plan, snakemake.config)
draws = summary.draws(plan, snakemake.params.folder)
table = summary.combinations(draws)
outputs.save(snakemake, draw(plan, table), table=table, draws=draws)
