"""Put the claims again to parts of the study, to see what decides the answers."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.verdicts import verdicts as draw
from bladerub.provenance import provenance
from bladerub.study import margins
from bladerub.study.findings import verdicts

job.log_to(snakemake.log[0])

table = margins.table(snakemake.config, snakemake.input.maps, snakemake.input.rom_accuracy)
tablefile.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(verdicts(table, by="variation"))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
