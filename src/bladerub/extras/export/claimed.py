"""The run that a file says it holds."""

from dataclasses import replace

from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.plan import PlannedRun, planned_run
from bladerub.study.solver import rows
from bladerub.study.store import StoredRun


def claimed_run(config: Config, file: str, run: StoredRun) -> PlannedRun:
    """Plan again what a stored run says it is; its own key shows whether `config` and blade made it.

    Raises `KeyError` if the file lacks an attribute of a run, or the config its casing.
    """
    attributes, case = run.attributes, CoatingCase.described(run.attributes)
    spec = replace(run_spec(config, case, attributes["f_omega"]), revolutions=attributes["revolutions"])
    # as of a short run asked for alone
    shortest = min(config.analysis.spectrum_revolutions, spec.revolutions)
    config = config.replaced("analysis.spectrum_revolutions", shortest)
    row = rows().stored(run) if "row" in run.data else None
    return planned_run(config, spec, file, "radial_displacement" in run.data, row)
