"""Fig. 6, wear patterns of the 2 + 5 casing, and the same of any coating.

The data are the map of its coating in ``maps/``.
"""

from bladerub.plots import style
from bladerub.plots.wear_map import wear_map
from bladerub.study.maps import read_map
from bladerub.workflow import job

job.log_to(snakemake.log[0])

figure = wear_map(read_map(str(snakemake.input.map)))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
