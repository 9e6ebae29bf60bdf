"""Tabulate and draw the findings of all sets of choices."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

import pandas as pd

from bladerub.extras.variations.verdicts import counts, side_by_side, verdicts
from bladerub.io import tables

paths = map(Path, snakemake.input.verdicts)
table = pd.concat([tables.read(p).assign(set=p.parent.name) for p in paths], ignore_index=True)
outputs.save(snakemake, verdicts(side_by_side(table, by="set")), table=table, counts=counts(table))
