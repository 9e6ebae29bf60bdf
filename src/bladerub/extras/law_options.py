"""A law of the coating and its parameters, as options of a command."""

import argparse

from bladerub.cli import inputs
from bladerub.io.errors import BadInput


def add_law_parameters_to(parser: inputs.Parser, option: str, text: str) -> None:
    """Add the option for the parameters of a law."""
    parser.option(option, text, action="append", default=[], metavar="NAME=VALUE")


def law_parameters(option: str, settings: list[str]) -> dict[str, float | str]:
    """Read what the command line gives for each parameter of a law."""
    values: dict[str, float | str] = {}
    for setting in settings:
        name, _, value = setting.partition("=")
        try:
            values[name.strip()] = inputs.quantity(value)
        except argparse.ArgumentTypeError:
            raise BadInput(f"{option} = {setting}: must be NAME=VALUE, such as viscosity=1e4") from None
    return values
