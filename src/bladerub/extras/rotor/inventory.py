"""The runs of rows of blades, counted."""

from pathlib import Path

from bladerub.extras.rotor.plan import PLAN, RUNS, read_plan
from bladerub.io.folders import study_folder
from bladerub.settings.study import Config
from bladerub.study.inventory import Inventory, take


def inventories(config: Config, results: Path, digest: str | None, thorough: bool) -> list[Inventory]:
    """Take the inventories of the rows of blades, if any were begun."""
    path = study_folder() / PLAN
    if not ((results / RUNS).exists() and path.exists()):
        return []
    plan = read_plan(path, config)
    return [
        take(config, plan.runs(config, name), results / RUNS / name, digest, thorough)
        for name in plan.combinations
    ]
