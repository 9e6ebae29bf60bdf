"""Fig. 19: worn depth around the casing (m), both angles of the elements, Figs. 17 and 18 and our speeds."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.plots.polar import wear_profiles
from bladerub.study.maps import read_map

maps, f1_hz = map(read_map, snakemake.input.maps), outputs.scales(snakemake).f1_hz
table, figure = wear_profiles([*maps], snakemake.params.speeds, f1_hz)
outputs.save(snakemake, figure, data=table)
