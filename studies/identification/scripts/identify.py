"""Tabulate and draw what the waves leave of the ranges, and how the best sets do."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import pandas as pd

from bladerub.extras.identification import candidates, sets, summary
from bladerub.extras.identification.plan import read_plan
from bladerub.extras.plots.identification import identification as draw
from bladerub.io import tables
from bladerub.workflow import outputs


def joined(paths, columns=()):
    """Put tables below one another."""
    return pd.concat([tables.read(path, columns) for path in paths], ignore_index=True)


plan, inputs = read_plan(snakemake.input.plan), snakemake.input
measured = summary.measured(inputs.quantities)
verdicts = summary.verdicts(inputs.verdicts)
of_candidates = joined(inputs.judged, candidates.COLUMNS)
candidate_rows = tables.read(inputs.candidates)
results = {
    "sets": summary.sets(plan, sets.positions(inputs.sets), candidates.misfit(measured)),
    "waves": joined(inputs.left, summary.LEFT),
    "emulators": joined(inputs.emulators, summary.EMULATORS),
    "targets": summary.targets(measured, joined(inputs.predictions, summary.PREDICTIONS)),
    "ranges": tables.read(inputs.ranges[-1]),
    "exclusions": summary.exclusions(verdicts),
    "candidates": candidate_rows,
    "counts": candidates.counts(candidate_rows, of_candidates),
    "verdicts": of_candidates,
}
remaining = sets.positions([inputs.next_sets[-1]])
figure = draw(plan, measured, remaining, candidates.read(inputs.candidates))
outputs.save(snakemake, figure, **results)
