"""Tabulate and draw the findings of all sets of choices."""

from pathlib import Path

from bladerub.extensions.calibration import collect
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.verdicts import verdicts as draw
from bladerub.study.findings import verdicts
from bladerub.workflow import job

job.log_to(snakemake.log[0])

paths = {Path(path).parts[-3]: path for path in snakemake.input.findings}
table = collect(paths)
tables.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(verdicts(table, by="set"))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
