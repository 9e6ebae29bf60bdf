"""How the tip may move besides, by a further coordinate of each node (``MOTIONS`` of `bladerub.plugins`).

A folder that adds such a motion has two modules. ``motion`` has `further`, the coordinates from those of the
blade, and `stiffness`, what the coating sets against them. ``kernel`` has functions that the time loop has in
the place of its own where the tip moves so (`bladerub.contact.laws.module_for`).
"""

from typing import Any

from bladerub import plugins
from bladerub.contact.spec import RunSpec
from bladerub.io.sources import digest_behind

_KEY = "tip_turns"  # of the block contact of the config


def place() -> str:
    """Name the folder of the motion; raises `ValueError` where the package is without it."""
    if _KEY not in (offered := plugins.offered("MOTIONS")):
        raise ValueError(f"contact.{_KEY} = true: this package is without that motion, must be false")
    return offered[_KEY]


def motion() -> Any:
    """Return the module of the motion; raises as `place`."""
    return plugins.load(f"{place()}.motion")


def motion_digest(spec: RunSpec) -> dict[str, str]:
    """Digest what the loop lacks of the motion in a run, as ``motion``; nothing of the paper's."""
    return {"motion": digest_behind(f"{place()}.kernel", f"{place()}.motion")} if spec.turns else {}
