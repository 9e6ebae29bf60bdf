"""The coatings that are run by both laws of friction."""

import itertools
from collections.abc import Mapping
from typing import Any

from bladerub.study.grid import CoatingCase


def compared(config: Mapping[str, Any]) -> list[CoatingCase]:
    """List them in pairs: one with a constant direction of the force, then the same by Coulomb's law."""
    return [
        CoatingCase(entry["casing"], *values, law=law)
        for entry in config["friction"]
        for values in itertools.product(*(map(float, entry[key]) for key in ("E", "K", "theta")))
        for law in ("theta", "coulomb")
    ]
