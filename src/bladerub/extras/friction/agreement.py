"""Whether the compared coatings can be run with the other sections of a config."""

from collections.abc import Iterator

from bladerub.config.checks import casing_problems, reads
from bladerub.settings.study import Config


@reads("casings", "contact", "blade", "friction")
def problems(config: Config) -> Iterator[str]:
    """Yield what is wrong with the casings of compared coatings, which have their interference."""
    for name in dict.fromkeys(entry.casing for entry in config.friction):
        yield from casing_problems(config, name)
