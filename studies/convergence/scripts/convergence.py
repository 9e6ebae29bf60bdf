"""How accurate runs are; peaks with finer bars, with more nodes, and with other treatments of impact."""

from bladerub.workflow import job, outputs

job.log_to(snakemake.log[0])

from pathlib import Path

from bladerub.blade.validation import read_reduced_blade
from bladerub.extras.study_runs import important_runs, study_runs
from bladerub.extras.verification import refinement, rigid_casing, steps, verify
from bladerub.io import tables
from bladerub.settings.study import typed
from bladerub.study.peaks import COLUMNS

blade, config, figure = read_reduced_blade(snakemake.input.blade), typed(snakemake.config), None
if path := snakemake.input.get("peaks"):
    peaks = tables.read(path, COLUMNS)
match Path(snakemake.output.table).stem:
    case "finer_bars":
        table = refinement.finer_bars(blade, config, peaks)
    case "more_nodes":  # builds its blades
        table = refinement.more_nodes(config, peaks)
    case "rigid_convergence":
        table = rigid_casing.table(blade, config, peaks)
    case "accuracy":
        important = important_runs(config, Path(snakemake.input.maps[0]).parent)
        candidates = {"all": study_runs(config), "important": important}
        table = verify.table(blade, config, candidates, report=job.log)
    case "steps":
        table = steps.table(blade, config, report=job.log)
        figure = steps.draw_steps(table)
outputs.save(snakemake, figure, table=table)
