"""What the claims say to each set of choices, side by side."""

from pathlib import Path

from bladerub import job, tablefile
from bladerub.plots import style
from bladerub.plots.verdicts import verdicts as draw
from bladerub.provenance import provenance
from bladerub.study.calibration import gather
from bladerub.study.findings import verdicts

job.log_to(snakemake.log[0])

answers = {Path(path).parts[-3]: path for path in snakemake.input.findings}
table = gather(answers)
tablefile.write(snakemake.output.table, table, provenance(snakemake.config))
figure = draw(verdicts(table, by="set"))
style.save(figure, snakemake.output.png, snakemake.output.pdf, snakemake.params.dpi)
