"""Fig. 6: wear patterns of the 2 + 5 casing.

The data are the map of its coating in ``maps/``.
"""

import sys

from bladerub.plots import style
from bladerub.plots.wear_map import wear_map
from bladerub.study.maps import read_map

sys.stderr = open(snakemake.log[0], "w", buffering=1)

figure = wear_map(read_map(snakemake.input.map))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
