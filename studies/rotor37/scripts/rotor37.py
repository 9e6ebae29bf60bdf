"""Reference numbers of Rotor 37 with their uncertainty, and the figures."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.extras.rotor37 import reference
from bladerub.extras.rotor37.figures import figures
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.settings.study import typed

plain, folder = snakemake.params.plan[reference.REFERENCE], snakemake.params.folder
config, of_reference = typed(plain), f"{folder}/{reference.REFERENCE}"
outputs.save(snakemake, origin=provenance(plain), digits="%.7g", **reference.tables_of(folder, config))
history = f"{of_reference}/history.csv"
tables.copy(history, snakemake.output.history)
drawn = figures(config, of_reference, tables.read(history))
for png, pdf in zip(snakemake.output.png, snakemake.output.pdf, strict=True):
    style.save(drawn[Path(png).stem], png, pdf, snakemake.params.dpi)
