"""Rigs as a file describes them (config/rigs.yaml)."""

from pathlib import Path

from bladerub.config.errors import ConfigError
from bladerub.extras import plans
from bladerub.extras.rig.settings import RigPlan
from bladerub.extras.rig.spec import Rig
from bladerub.study.grid import element_law

PLAN = Path("config/rigs.yaml")
"""The rigs of a study, in its folder."""


def read_rigs(path: str | Path) -> list[Rig]:
    """Read rigs; raises `ConfigError`, with file, line, key, value and what would be right."""
    rigs = []
    for name, located in plans.read_plan(path, RigPlan).content["rigs"].content.items():
        values = located.plain()
        try:
            law = element_law({"contact": {"law": values.pop("law", {})}})
            assumed = tuple(values.pop("assumed", ()))
            rigs.append(Rig(name, law=law, assumed=assumed, **values))
        except ValueError as error:
            raise ConfigError.at(located.location, f"rigs.{name}.{error}") from error
    return rigs
