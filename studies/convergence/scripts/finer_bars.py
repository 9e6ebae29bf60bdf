"""Find the peaks of some coatings again with finer bars."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.verification.refinement import finer_bars
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study.peaks import COLUMNS
from bladerub.workflow import outputs

blade, peaks = read_reduced_blade(snakemake.input.blade), tables.read(snakemake.input.peaks, COLUMNS)
outputs.save(snakemake, table=finer_bars(blade, typed(snakemake.config), peaks))
