"""Find the peaks of some coatings again: with finer bars, more nodes, or another treatment of impact."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.verification import refinement, rigid_casing
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study.peaks import COLUMNS
from bladerub.workflow import outputs

blade, config = read_reduced_blade(snakemake.input.blade), typed(snakemake.config)
peaks = tables.read(snakemake.input.peaks, COLUMNS)
if snakemake.rule == "finer_bars":
    table = refinement.finer_bars(blade, config, peaks)
elif snakemake.rule == "more_nodes":  # builds its blades
    table = refinement.more_nodes(config, peaks)
else:
    table = rigid_casing.table(blade, config, peaks)
outputs.save(snakemake, table=table)
