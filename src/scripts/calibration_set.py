"""One set of choices: a small study of its own, and what the claims say to it."""

import sys

from bladerub import job, tablefile
from bladerub.provenance import provenance
from bladerub.study.calibration import answer

job.log_to(snakemake.log[0])

found = answer(
    snakemake.params.choices, snakemake.params.folder, report=lambda run: print(run, file=sys.stderr)
)
tablefile.write(snakemake.output[0], found, provenance(snakemake.params.choices))
