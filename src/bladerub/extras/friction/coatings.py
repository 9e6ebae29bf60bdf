"""The coatings that are run by both laws of friction."""

import itertools

from bladerub.settings.study import Config
from bladerub.study.grid import CoatingCase


def compared(config: Config) -> list[CoatingCase]:
    """List them in pairs: one with a constant direction of the force, then the same by Coulomb's law."""
    return [
        CoatingCase(entry.casing, *values, law=law)
        for entry in config.friction
        for values in itertools.product(entry.E, entry.K, entry.theta)
        for law in ("theta", "coulomb")
    ]
