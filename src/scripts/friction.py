"""Compare Coulomb friction with a contact force of constant direction over all speeds."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.friction import friction as draw
from bladerub.provenance import provenance
from bladerub.study.friction import table as compare

job.log_to(snakemake.log[0])

constant, coulomb = snakemake.input.manifests[::2], snakemake.input.manifests[1::2]
table = compare(zip(constant, coulomb, strict=True), snakemake.params.revolutions)
tablefile.write(snakemake.output.table, table, provenance(snakemake.config))
style.save(draw(table), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
