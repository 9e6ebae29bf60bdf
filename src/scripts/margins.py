"""Put the claims again to parts of the study, to see what decides the answers."""

import sys

from bladerub.plots import style
from bladerub.plots.verdicts import verdicts as draw
from bladerub.study import margins
from bladerub.study.findings import verdicts

sys.stderr = open(snakemake.log[0], "w", buffering=1)

table = margins.table(snakemake.config, snakemake.input.maps, snakemake.input.rom_accuracy)
table.to_csv(snakemake.output.table, index=False)
figure = draw(verdicts(table, by="variation"))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
