"""Find what the waves up to one have left of the ranges, and draw sets from it."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import identification as summary
from bladerub.extras.variations import waves
from bladerub.extras.variations.plan import read

plan, wave = read("identification", snakemake.params.plan), int(snakemake.wildcards.wave)
measured, positions = summary.measured(snakemake.input.quantities), waves.read(snakemake.input.sets)
outputs.save(snakemake, **summary.left(plan, wave, measured, positions))
