"""Find the resonant peaks of every coating."""

import sys

from bladerub import tablefile
from bladerub.provenance import provenance
from bladerub.study import peaks

sys.stderr = open(snakemake.log[0], "w", buffering=1)

table = peaks.table(snakemake.config, snakemake.input.maps)
tablefile.write(snakemake.output[0], table, provenance(snakemake.config))
