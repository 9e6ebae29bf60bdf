"""Compare the peaks of all speed sweeps with those at constant speed."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.passages import sweeps
from bladerub.extras.plots.passages import sweeps as draw
from bladerub.settings.study import typed
from bladerub.study.maps import read_map

swept = [sweeps.read(path) for path in snakemake.input.sweeps]
maps = {coating.case: coating for coating in map(read_map, snakemake.input.maps)}
table = sweeps.table(typed(snakemake.config), swept, maps)
outputs.save(snakemake, draw(swept, maps, outputs.scales(snakemake)), table=table)
