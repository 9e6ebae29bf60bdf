"""Whether the law of the coating of a config can be computed."""

from collections.abc import Iterator

from bladerub.config.checks import reads
from bladerub.extras.laws import heating
from bladerub.settings.study import Config
from bladerub.study.grid import UNSCALED, element_law


@reads("contact")
def problems(config: Config) -> Iterator[str]:
    """Yield what is wrong with the law: its file, its parameters, or its layer in this coating."""
    try:
        scale = config.contact.plugged("scale", UNSCALED)
        heating.check(element_law(config), config.contact.layer_thickness * scale.length)
    except ValueError as error:
        yield f"contact.law.{error}"
