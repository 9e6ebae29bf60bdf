"""Set the peaks of all passages beside those at constant speed."""

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.sweeps import sweeps as draw
from bladerub.provenance import provenance
from bladerub.study import sweeps
from bladerub.study.maps import read_map

job.log_to(snakemake.log[0])

passages = [sweeps.read(path) for path in snakemake.input.passages]
maps = {coating.case: coating for coating in map(read_map, snakemake.input.maps)}
table = sweeps.table(snakemake.config, passages, maps)
tablefile.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(passages, maps)
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
