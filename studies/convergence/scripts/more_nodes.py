"""Find the peaks of some coatings again with more interface nodes."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.verification.refinement import more_nodes
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study.peaks import COLUMNS
from bladerub.workflow import outputs

outputs.save(
    snakemake, table=more_nodes(typed(snakemake.config), tables.read(snakemake.input.peaks, COLUMNS))
)
