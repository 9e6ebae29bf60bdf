"""Find the peaks of some coatings again with more interface nodes."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.verification.more_nodes import table
from bladerub.io import tables
from bladerub.study.peaks import COLUMNS
from bladerub.workflow import outputs

outputs.save(snakemake, table=table(snakemake.config, tables.read(snakemake.input.peaks, COLUMNS)))
