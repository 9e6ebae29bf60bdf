"""The run that a file says it holds."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from bladerub.study.grid import CoatingCase, run_spec
from bladerub.study.plan import PlannedRun, planned_run
from bladerub.study.solver import rows
from bladerub.study.store import StoredRun


def claimed_run(config: Mapping[str, Any], file: str, run: StoredRun) -> PlannedRun:
    """Plan again what a stored run says it is; its own key shows whether `config` and blade made it.

    Raises `KeyError` if the file lacks an attribute of a run, or the config its casing.
    """
    attributes, analysis = run.attributes, config["analysis"]
    case = CoatingCase.described(attributes)
    spec = replace(run_spec(config, case, attributes["f_omega"]), revolutions=attributes["revolutions"])
    shortest = min(analysis["spectrum_revolutions"], spec.revolutions)  # as of a short run asked for alone
    config = {**config, "analysis": {**analysis, "spectrum_revolutions": shortest}}
    row = rows().stored(run) if "row" in run.data else None
    return planned_run(config, spec, file, "radial_displacement" in run.data, row)
