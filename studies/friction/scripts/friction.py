"""Compare Coulomb friction with a contact force of constant direction over all speeds."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.friction.table import table as compare
from bladerub.extras.plots.studies import friction as draw

constant, coulomb = snakemake.input.manifests[::2], snakemake.input.manifests[1::2]
table = compare(zip(constant, coulomb, strict=True), snakemake.params.revolutions)
outputs.save(snakemake, draw(table, outputs.scales(snakemake)), table=table)
