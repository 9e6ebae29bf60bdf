"""How the tip may move besides, by a further coordinate of each node (``MOTIONS`` of `bladerub.plugins`).

A folder that adds such a motion has two modules. ``motion`` has `further`, the coordinates from those of the
blade, and `stiffness`, what the coating sets against them. ``kernel`` has the counterparts of functions of
the time loop (`bladerub.contact.kernel.composition`).
"""

from typing import Any

from bladerub import plugins
from bladerub.contact.spec import RunSpec
from bladerub.io.sources import digest_behind
from bladerub.numerics.lanes import counterparts

_KEY = "tip_turns"  # of the block contact of the config


def motion() -> Any:
    """Return the module of the motion; raises `ValueError` where the package is without it."""
    if _KEY not in (offered := plugins.offered("MOTIONS")):
        raise ValueError(f"contact.{_KEY} = true: this package is without that motion, must be false")
    return plugins.load(f"{offered[_KEY]}.motion")


def motion_digest(spec: RunSpec) -> dict[str, str]:
    """Digest what the loop lacks of the motion in a run, as ``motion``; nothing of the paper's."""
    if not spec.turns:
        return {}
    return {"motion": digest_behind(*counterparts(), motion().__name__.removeprefix("bladerub."))}
