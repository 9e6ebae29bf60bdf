"""Table and figure of the largest stress of the blade at the peaks."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.plots.studies import stress as draw
from bladerub.extras.stress.run import table
from bladerub.io import tables
from bladerub.plots.scales import Scales
from bladerub.settings.study import typed
from bladerub.study.peaks import COLUMNS

blade, peaks = read_reduced_blade(snakemake.input.blade), tables.read(snakemake.input.peaks, COLUMNS)
stresses = table(snakemake.input.mesh, blade, typed(snakemake.config), peaks)
outputs.save(snakemake, draw(stresses, Scales(f1_hz=blade.f1_hz)), table=stresses)
