"""Find what the waves up to one have left of the ranges, and draw sets from it."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.identification import sets, summary, waves
from bladerub.extras.identification.emulator import emulators
from bladerub.extras.identification.plan import read_plan
from bladerub.io import tables
from bladerub.io.provenance import provenance

plan, wave = read_plan(snakemake.params.plan), int(snakemake.wildcards.wave)
measured = summary.measured(snakemake.input.quantities)
positions = sets.positions(snakemake.input.sets).loc[measured.index].to_numpy()
emulated = emulators(positions, measured)
left = waves.remaining(plan, emulated)
drawn = waves.draw(plan, wave, left, emulated, positions)
first = plan.first(wave + 1)
made = {
    "left": summary.left_after(wave, len(measured), left),
    "emulators": summary.emulated(wave, emulated, left, positions, measured),
    "ranges": summary.ranges(plan, left),
    "next_sets": sets.as_table(plan, first, drawn),
    "predictions": summary.predictions(emulated, first, drawn),
}
origin = provenance(snakemake.config)
for name, table in made.items():
    tables.write(snakemake.output[name], table, origin)
