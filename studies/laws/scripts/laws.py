"""Stress–strain cycles of one element by the laws beside the paper's, for some of their parameters."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.contact.spec import Coating
from bladerub.extras.laws import cycles

panels = cycles.panels(Coating(**snakemake.params.coating))
outputs.save(snakemake, cycles.draw(panels), data=cycles.table(panels))
