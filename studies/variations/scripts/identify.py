"""Tabulate and draw what the waves leave of the ranges, and how the best sets do."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import identification as summary
from bladerub.extras.variations import waves
from bladerub.extras.variations.figures import identification as draw
from bladerub.extras.variations.job import read as joined
from bladerub.extras.variations.plan import read
from bladerub.io import tables

plan, inputs = read("identification", snakemake.input.plan), snakemake.input
measured, candidates = summary.measured(inputs.quantities), tables.read(inputs.candidates)
of_candidates = summary.of_candidates(plan, joined(inputs.judged))
results = {
    "sets": summary.sets(plan, waves.read(inputs.sets), measured),
    "waves": joined(inputs.left),
    "emulators": joined(inputs.emulators),
    "targets": summary.targets(measured, joined(inputs.predictions)),
    "ranges": tables.read(inputs.ranges[-1]),
    "exclusions": summary.exclusions(joined(inputs.verdicts)),
    "candidates": candidates,
    "counts": summary.counts(candidates, of_candidates),
    "verdicts": of_candidates,
}
best, remaining = waves.read([inputs.candidates], waves.CANDIDATE), waves.read([inputs.next_sets[-1]])
outputs.save(snakemake, draw(plan, measured, remaining, best), **results)
