"""List the sets of one wave: the first are spread over all ranges, others drawn from what was left."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.identification import sets, waves
from bladerub.extras.identification.plan import read_plan
from bladerub.io import tables
from bladerub.io.provenance import provenance

plan, wave = read_plan(snakemake.params.plan), int(snakemake.wildcards.wave)
if wave == 1:
    drawn = waves.first(plan, snakemake.config)
else:
    drawn = sets.positions([snakemake.input.next_sets]).to_numpy()[: plan.size(wave)]
table = sets.as_table(plan, plan.first(wave), drawn)
tables.write(snakemake.output.sets, table, provenance(snakemake.config))
