"""Set the peaks of all passages beside those at constant speed."""

from bladerub.extensions import sweeps
from bladerub.extensions.plots.sweeps import sweeps as draw
from bladerub.io import tables
from bladerub.io.provenance import provenance
from bladerub.plots import style
from bladerub.study.maps import read_map
from bladerub.workflow import job

job.log_to(snakemake.log[0])

passages = [sweeps.read(path) for path in snakemake.input.passages]
maps = {coating.case: coating for coating in map(read_map, snakemake.input.maps)}
table = sweeps.table(snakemake.config, passages, maps)
tables.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(passages, maps)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
