"""Rigs as a file describes them (config/rigs.yaml)."""

from pathlib import Path

from bladerub.config.errors import ConfigError
from bladerub.contact.laws import element_law
from bladerub.extras import plans
from bladerub.extras.rig.settings import RigPlan, RigSettings
from bladerub.extras.rig.spec import Rig

PLAN = Path("config/rigs.yaml")
"""The rigs of a study, in its folder."""


def read_rigs(path: str | Path) -> list[Rig]:
    """Read rigs; raises `ConfigError`, with file, line, key, value and what would be right."""
    rigs = []
    for name, located in plans.read_plan(path, RigPlan).content["rigs"].content.items():
        rig = RigSettings.model_validate(located.plain())
        try:
            values = rig.plain() | {"law": element_law(rig.law), "assumed": tuple(rig.assumed)}
            rigs.append(Rig(name, **values))
        except ValueError as error:
            raise ConfigError.at(located.location, f"rigs.{name}.{error}") from error
    return rigs
