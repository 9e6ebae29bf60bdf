"""Find the bands of peaks and runs, and judge the claims of the paper on each draw of the study."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from bladerub.extras.ensembles import bands, ensemble
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study import findings
from bladerub.study.findings.evidence import read_rom_accuracy
from bladerub.study.maps import read_map

config, inputs = typed(snakemake.config), snakemake.input
study = [read_map(path) for path in inputs.maps], [ensemble.read(path) for path in inputs.ensembles]
frames = {"peaks": bands.of_peaks(config, *study), "runs": bands.of_runs(config, *study)}
if path := inputs.get("findings"):
    verdicts, accuracy = tables.read(path, findings.COLUMNS), read_rom_accuracy(inputs.rom_accuracy)
    frames["claims"] = bands.of_findings(config, verdicts, accuracy, *study)
outputs.save(snakemake, **frames)
