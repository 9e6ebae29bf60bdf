"""Find what the waves up to one have left of the ranges, and draw sets from it."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

import pandas as pd

from bladerub.extras.variations import identification as summary
from bladerub.extras.variations import waves
from bladerub.extras.variations.emulator import emulators
from bladerub.extras.variations.plan import read

plan, wave = read("identification", snakemake.params.plan), int(snakemake.wildcards.wave)
measured = summary.measured(snakemake.input.quantities)
positions = waves.read(snakemake.input.sets).loc[measured.index].to_numpy()
emulated = emulators(positions, measured)
remaining = waves.remaining(plan, emulated)
drawn = waves.draw(plan, wave, remaining, emulated, positions)
first = plan.first(wave + 1)
left = {"wave": wave, "sets": len(measured), "given_up": remaining.given_up, "remaining": remaining.share}
outputs.save(
    snakemake,
    left=pd.DataFrame([left]),
    emulators=summary.emulated(wave, emulated, remaining),
    ranges=summary.ranges(plan, remaining),
    next_sets=waves.as_table(plan, first, drawn),
    predictions=summary.predictions(emulated, first, drawn),
)
