"""Tabulate and draw the findings of all sets of choices."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.extras.variations.calibration import collect, counts, verdicts
from bladerub.extras.variations.verdicts import verdicts as draw
from bladerub.workflow import outputs

table = collect({Path(path).parent.name: path for path in snakemake.input.verdicts})
outputs.save(snakemake, draw(verdicts(table, by="set")), table=table, counts=counts(table))
