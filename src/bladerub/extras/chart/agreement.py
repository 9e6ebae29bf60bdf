"""Whether the chart can be made with the other sections of a config."""

from collections.abc import Iterator

from bladerub.config.checks import casing_problems, reads
from bladerub.settings.study import Config


@reads("casings", "contact", "blade", "chart")
def problems(config: Config) -> Iterator[str]:
    """Yield what is wrong with the casing of the chart, whose coatings have its interference."""
    yield from casing_problems(config, config.chart.casing)
