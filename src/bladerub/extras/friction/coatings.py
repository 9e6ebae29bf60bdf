"""The coatings that are run by both laws of friction, and whether a config can have them."""

import itertools
from collections.abc import Iterator

from bladerub.config.checks import casing_problems, reads
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


@reads("casings", "contact", "blade", "friction")
def problems(config: Config) -> Iterator[str]:
    """Yield what is wrong with the casings of compared coatings, which have their interference."""
    for name in dict.fromkeys(entry.casing for entry in config.friction):
        yield from casing_problems(config, name)
