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


plan, given = read_plan(snakemake.input.plan), snakemake.input
measured = summary.measured(given.quantities)
verdicts = summary.verdicts(given.verdicts)
of_candidates = joined(given.judged, candidates.COLUMNS)
chosen = tables.read(given.candidates)
made = {
    "sets": summary.sets(plan, sets.positions(given.sets), candidates.misfit(measured)),
    "waves": joined(given.left, summary.LEFT),
    "emulators": joined(given.emulators, summary.EMULATORS),
    "targets": summary.targets(measured, joined(given.predictions, summary.PREDICTIONS)),
    "ranges": tables.read(given.ranges[-1]),
    "exclusions": summary.exclusions(verdicts),
    "candidates": chosen,
    "counts": candidates.counts(chosen, of_candidates),
    "verdicts": of_candidates,
}
left = sets.positions([given.next_sets[-1]])
figure = draw(plan, measured, left, candidates.read(given.candidates))
outputs.save(snakemake, figure, **made)
