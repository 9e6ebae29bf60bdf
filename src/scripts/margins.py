"""Put the claims again to parts of the study, to see what decides the answers."""

import sys

from bladerub import tablefile
from bladerub.plots import style
from bladerub.plots.verdicts import verdicts as draw
from bladerub.provenance import provenance
from bladerub.study import margins
from bladerub.study.findings import verdicts

sys.stderr = open(snakemake.log[0], "w", buffering=1)

table = margins.table(snakemake.config, snakemake.input.maps, snakemake.input.rom_accuracy)
tablefile.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(verdicts(table, by="variation"))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
