"""Collect the cases that NLstep computed, and say which NLstep it was."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from pathlib import Path

import pandas as pd

from bladerub.extras.rotor37.nlstep import COLUMNS, describe
from bladerub.io import tables
from bladerub.io.provenance import PREFIX, provenance
from bladerub.workflow import outputs

numbers = pd.concat([tables.read(path, COLUMNS) for path in snakemake.input.numbers], ignore_index=True)
made_by = {f"{PREFIX}program": describe(Path(snakemake.input.program))}
origin = provenance(snakemake.params.config) | made_by
outputs.save(snakemake, origin=origin, digits="%.7g", table=numbers)
