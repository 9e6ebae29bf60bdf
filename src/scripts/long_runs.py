"""Judge the long runs of all coatings after more and more of their revolutions."""

from bladerub.extensions import long_runs
from bladerub.extensions.plots.long_runs import long_runs as draw
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.workflow import job

job.log_to(snakemake.log[0])

coatings = [long_runs.read(path) for path in snakemake.input.long]
table = long_runs.table(snakemake.config, coatings)
tables.write(snakemake.output.table, table, provenance(snakemake.config))
style.save(draw(coatings, table), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
