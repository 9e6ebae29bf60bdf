"""Fig. 6, wear patterns of the 2 + 5 casing, or of any coating; the data are its map in ``maps/``."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.maps import wear_map
from bladerub.study.maps import read_map

outputs.save(snakemake, wear_map(read_map(snakemake.input.map), outputs.scales(snakemake)))
