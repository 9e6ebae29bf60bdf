"""One set of choices: a small study of its own, and what the claims say to it."""

import sys

from bladerub.extensions.calibration import answer
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.workflow import job

job.log_to(snakemake.log[0])

found = answer(
    snakemake.params.choices, snakemake.params.folder, report=lambda run: print(run, file=sys.stderr)
)
tables.write(snakemake.output[0], found, provenance(snakemake.params.choices))
