"""A law of the coating and its parameters, as options of a command and as a block of the config."""

import argparse
from collections.abc import Mapping

from bladerub.cli import inputs


def add_law_parameters_to(parser: inputs.Parser, option: str, text: str) -> None:
    """Add the option for the parameters of a law."""
    parser.option(option, text, action="append", default=[], metavar="NAME=VALUE")


def law_parameters(option: str, settings: list[str], law: str | None) -> dict[str, float | str]:
    """Read what the command line gives for each parameter of a law, converted if the law has it."""
    values: dict[str, float | str] = {}
    for setting in settings:
        name, _, value = setting.partition("=")
        try:
            values[name.strip()] = inputs.quantity(value)
        except argparse.ArgumentTypeError:
            raise inputs.InputError(
                f"{option} = {setting}: must be NAME=VALUE, such as viscosity=1e4"
            ) from None
    if law is None or not values:
        return values

    from bladerub.config.quantities import law_numbers

    return law_numbers(law, values)


def law_entry(law: str, parameters: Mapping[str, float]) -> dict[str, str | float]:
    """Return ``contact.law`` of a config for a law by its name, or by its file, which ends in ``.py``."""
    return {"file" if law.endswith(".py") else "name": law, **parameters}
