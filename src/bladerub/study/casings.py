"""Casings of the config, in SI units: nodal diameters, bumps, or of a kind that plugs in (``CASINGS``)."""

import math
from collections.abc import Mapping
from typing import Any

from bladerub import plugins
from bladerub.contact.spec import Casing


def casing_spec(name: str, entry: Mapping[str, Any], length_scale: float = 1.0) -> Casing:
    """Describe an entry of ``casings`` in SI units; `length_scale` is ``contact.scale.length``.

    Raises a ValueError that begins with the key if a kind that plugs in cannot be read, or none does.
    """
    if kind := _kind(entry):
        return kind.casing_spec(name, entry, length_scale)
    return Casing(
        name=name,
        nodal_diameters=tuple(int(n) for n in entry["nodal_diameters"]),
        weights=tuple(float(weight) for weight in entry["weights"]),
        amplitude=float(entry["amplitude"] * length_scale),
        interference=float(entry["interference"] * length_scale),
        start_angle=math.radians(entry["start_angle"]),
        bump_width=float(entry.get("bump_width", 0.0)),
    )


def nodal_diameters(entry: Mapping[str, Any]) -> list[int]:
    """List the nodal diameters of a casing of the config: those with weight."""
    if kind := _kind(entry):
        return kind.nodal_diameters(entry)
    return [n for n, w in zip(entry["nodal_diameters"], entry["weights"], strict=False) if w]


def _kind(entry: Mapping[str, Any]) -> Any:
    """Return the module that describes an entry by the key it has; None for nodal diameters."""
    if "nodal_diameters" in entry:
        return None
    for key, place in plugins.offered("CASINGS").items():
        if key in entry:
            return plugins.load(place)
    raise ValueError("nodal_diameters: missing, this package has casings of these alone")
