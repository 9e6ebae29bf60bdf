"""Compare Coulomb friction with a contact force of constant direction over all speeds."""

from bladerub.extensions.friction import table as compare
from bladerub.extensions.plots.friction import friction as draw
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.workflow import job

job.log_to(snakemake.log[0])

constant, coulomb = snakemake.input.manifests[::2], snakemake.input.manifests[1::2]
table = compare(zip(constant, coulomb, strict=True), snakemake.params.revolutions)
tables.write(snakemake.output.table, table, provenance(snakemake.config))
style.save(draw(table), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
