"""Repeat runs on the rigid casing with other modes, time steps and treatments of impact."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.verification.rigid_casing import table
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study.peaks import COLUMNS
from bladerub.workflow import outputs

blade, peaks = read_reduced_blade(snakemake.input.blade), tables.read(snakemake.input.peaks, COLUMNS)
outputs.save(snakemake, table=table(blade, typed(snakemake.config), peaks))
