"""Tables of the rows of blades."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.rotor import summary
from bladerub.extras.rotor.plan import read_plan
from bladerub.settings.study import typed

config = typed(snakemake.config)
plan = read_plan(snakemake.input.plan, config)
draws = summary.draws(plan, snakemake.params.folder, config.analysis)
half = summary.combinations(summary.first_half(draws))
outputs.save(snakemake, table=summary.combinations(draws), half=half, draws=draws)
