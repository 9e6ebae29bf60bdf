"""Judge for every run whether it diverges."""

import sys

from bladerub import tablefile
from bladerub.provenance import provenance
from bladerub.study import divergence

sys.stderr = open(snakemake.log[0], "w", buffering=1)

table = divergence.table(snakemake.config, snakemake.input.maps)
tablefile.write(snakemake.output[0], table, provenance(snakemake.config))
