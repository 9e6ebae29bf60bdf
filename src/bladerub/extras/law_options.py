"""The parameters of a law of the coating, as an option of a command."""

import argparse
from typing import Any

from bladerub.cli import inputs
from bladerub.io.errors import BadInput

PARAMETER: dict[str, Any] = {"action": "append", "default": [], "metavar": "NAME=VALUE"}


def law_parameters(option: str, settings: list[str]) -> dict[str, float | str]:
    """Read what the command line gives for each parameter of a law."""
    values: dict[str, float | str] = {}
    for setting in settings:
        name, _, value = setting.partition("=")
        if name.strip() in values:
            raise BadInput(f"{option} = {setting}: must be there once for each parameter")
        try:
            values[name.strip()] = inputs.quantity(value)
        except argparse.ArgumentTypeError:
            raise BadInput(f"{option} = {setting}: must be NAME=VALUE, such as viscosity=1e4") from None
    return values
