"""Make the small study of one set of choices, and judge the claims."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

import sys

from bladerub.extras.calibration.sets import judge
from bladerub.io import tables
from bladerub.io.provenance import provenance

findings = judge(
    snakemake.params.choices, snakemake.params.folder, report=lambda run: print(run, file=sys.stderr)
)
tables.write(snakemake.output[0], findings, provenance(snakemake.params.choices))
