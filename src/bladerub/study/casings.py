"""Casings of the config, in SI units: nodal diameters, bumps, or of a kind that plugs in (``CASINGS``)."""

import math
from typing import Any

from bladerub import plugins
from bladerub.contact.spec import Casing
from bladerub.settings.contact import AnyCasing
from bladerub.settings.contact import Casing as Waves


def casing_spec(name: str, entry: AnyCasing, length_scale: float = 1.0) -> Casing:
    """Describe an entry of ``casings`` in SI units; `length_scale` is ``contact.scale.length``.

    Raises a ValueError that begins with the key if a kind that plugs in cannot be read, or none does.
    """
    if not isinstance(entry, Waves):
        return _kind(entry).casing_spec(name, entry, length_scale)
    return Casing(
        name=name,
        nodal_diameters=tuple(entry.nodal_diameters),
        weights=tuple(entry.weights),
        amplitude=entry.amplitude * length_scale,
        interference=entry.interference * length_scale,
        start_angle=math.radians(entry.start_angle),
        bump_width=entry.bump_width or 0.0,
    )


def nodal_diameters(entry: AnyCasing) -> list[int]:
    """List the nodal diameters of a casing of the config: those with weight."""
    if not isinstance(entry, Waves):
        return _kind(entry).nodal_diameters(entry)
    return [n for n, w in zip(entry.nodal_diameters, entry.weights, strict=False) if w]


def _kind(entry: AnyCasing) -> Any:
    """Return the module that describes an entry by the key it has."""
    for key, place in plugins.offered("CASINGS").items():
        if entry.plugged(key) is not None:
            return plugins.load(place)
    raise ValueError("nodal_diameters: missing, this package has casings of these alone")
