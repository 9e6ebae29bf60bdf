"""Compare the peaks of all speed sweeps with those at constant speed."""

from bladerub.extensions import sweeps
from bladerub.extensions.plots.sweeps import sweeps as draw
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.study.maps import read_map
from bladerub.workflow import job

job.log_to(snakemake.log[0])

swept = [sweeps.read(path) for path in snakemake.input.sweeps]
maps = {coating.case: coating for coating in map(read_map, snakemake.input.maps)}
table = sweeps.table(snakemake.config, swept, maps)
tables.write(snakemake.output.table, table, provenance(snakemake.config))
style.save(draw(swept, maps), snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
