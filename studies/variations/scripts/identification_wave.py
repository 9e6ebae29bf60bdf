"""List the sets of one wave: the first are spread over all ranges, others drawn from what was left."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import waves
from bladerub.extras.variations.plan import read
from bladerub.settings.study import typed

plan, wave = read("identification", snakemake.params.plan), int(snakemake.wildcards.wave)
if wave == 1:
    drawn = waves.first(plan, typed(snakemake.config))
else:
    drawn = waves.read([snakemake.input.next_sets]).to_numpy()[: plan.size(wave)]
outputs.save(snakemake, sets=waves.as_table(plan, plan.first(wave), drawn))
