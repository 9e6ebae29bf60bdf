"""Tabulate and draw what the waves leave of the ranges, and how the best sets do."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.variations import candidates, waves
from bladerub.extras.variations import identification as summary
from bladerub.extras.variations.figures import identification as draw
from bladerub.extras.variations.job import read as joined
from bladerub.extras.variations.plan import read
from bladerub.io import tables

plan, inputs = read("identification", snakemake.input.plan), snakemake.input
measured = summary.measured(inputs.quantities)
verdicts = joined(inputs.verdicts)
of_candidates = candidates.verdicts(plan, joined(inputs.judged))
candidate_rows = tables.read(inputs.candidates)
results = {
    "sets": summary.sets(plan, waves.read(inputs.sets), candidates.misfit(measured)),
    "waves": joined(inputs.left),
    "emulators": joined(inputs.emulators),
    "targets": summary.targets(measured, joined(inputs.predictions)),
    "ranges": tables.read(inputs.ranges[-1]),
    "exclusions": summary.exclusions(verdicts),
    "candidates": candidate_rows,
    "counts": candidates.counts(candidate_rows, of_candidates),
    "verdicts": of_candidates,
}
remaining = waves.read([inputs.next_sets[-1]])
figure = draw(plan, measured, remaining, candidates.read(inputs.candidates))
outputs.save(snakemake, figure, **results)
