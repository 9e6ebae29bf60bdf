"""Judge the claims of the paper on each draw of the study."""

from bladerub.workflow import job

job.log_to(snakemake.log[0])

from bladerub.extras.ensembles import bands, ensemble
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study import findings
from bladerub.study.findings.evidence import read_rom_accuracy
from bladerub.study.maps import read_map
from bladerub.workflow import outputs

table = bands.of_findings(
    typed(snakemake.config),
    tables.read(snakemake.input.findings, findings.COLUMNS),
    read_rom_accuracy(snakemake.input.rom_accuracy),
    [read_map(path) for path in snakemake.input.maps],
    [ensemble.read(path) for path in snakemake.input.ensembles],
)
outputs.save(snakemake, table=table)
