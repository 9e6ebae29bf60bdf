"""Put the claims again to parts of the study, to see what decides the answers."""

from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.plots.verdicts import verdicts as draw
from bladerub.study import margins
from bladerub.study.findings import verdicts
from bladerub.workflow import job

job.log_to(snakemake.log[0])

table = margins.table(snakemake.config, snakemake.input.maps, snakemake.input.rom_accuracy)
tables.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(verdicts(table, by="variation"))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
