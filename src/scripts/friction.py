"""Compare Coulomb friction with a contact force of constant direction over all speeds."""

from bladerub.extensions.friction import table as compare
from bladerub.extensions.plots.friction import friction as draw
from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

constant, coulomb = snakemake.input.manifests[::2], snakemake.input.manifests[1::2]
table = compare(zip(constant, coulomb, strict=True), snakemake.params.revolutions)
outputs.save(snakemake, draw(table), table=table)
