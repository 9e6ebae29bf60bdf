"""Fig. 19: worn depth around the casing (m), both angles of the elements, Figs. 17 and 18 and our speeds."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.polar import wear_profiles
from bladerub.study.maps import read_map

maps = [read_map(path) for path in snakemake.input.maps]
table, figure = wear_profiles(maps, snakemake.params.speeds, outputs.f1_hz(snakemake))
outputs.save(snakemake, figure, data=table)
