"""What a config, or the options of a command, say of a law of the coating."""

import argparse
from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import ConfigDict, Field, model_validator

from bladerub.config.files import Located
from bladerub.config.keys import Key
from bladerub.config.quantities import converted
from bladerub.extras.law_reading import parameters_in
from bladerub.io.errors import BadInput
from bladerub.settings.fields import Form, Omitted, Section, Unit, disagreement

PARAMETER: dict[str, Any] = {"action": "append", "default": [], "metavar": "NAME=VALUE"}  # of their option


class Law(Section):
    """How an element of the layer deforms and wears (docs/laws.md); the paper's law, plastic, if not given.

    The name of a law or the file of one of your own, and a value for each of its parameters, in its own unit.
    ``contact.scale`` does not apply to them.
    """

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Annotated[float, Unit("SI"), Field(ge=-1e15, le=1e15)]]

    name: Annotated[Omitted[str], Form("the name of a law")] = Field(None, pattern=r"^[a-z]\w*$")
    """docs/laws.md lists the laws, with the parameters of each and their units."""
    file: Annotated[Omitted[str], Form("the path of a Python file that ends in .py")] = Field(
        None, pattern=r"^.+\.py$"
    )
    """Instead of the name: a law of your own, which `bladerub check-law` checks; its path is from the folder
    of the study. It is run, so read a file of somebody else first."""

    @model_validator(mode="after")
    def _has_one_law(self) -> "Law":
        if self.name is not None and self.file is not None:
            raise disagreement("file", "must be without the name of a law")
        return self

    @classmethod
    def further_keys(cls, values: Mapping[str, Any]) -> dict[str, Key]:
        """Give the parameters of the law their units."""
        try:
            parameters = parameters_in(values)
        except (OSError, ValueError, TypeError):  # which the law's own check says
            return {}
        return {name: Key("a number", unit=Unit(parameter.unit)) for name, parameter in parameters.items()}


def law_entry(law: str, parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return ``contact.law`` of a config for a law by its name or file, with quantities as plain numbers."""
    entry = {"file" if law.endswith(".py") else "name": law, **parameters}
    return converted(Located.of(entry), Law)[0].plain()


def law_parameters(option: str, settings: list[str]) -> dict[str, float | str]:
    """Read what the command line gives for each parameter of a law."""
    from bladerub.cli import inputs  # who reads a config does without

    values = {}
    for setting in settings:
        name, _, value = setting.partition("=")
        if name.strip() in values:
            raise BadInput(f"{option} = {setting}: must be there once for each parameter")
        try:
            values[name.strip()] = inputs.quantity(value)
        except argparse.ArgumentTypeError:
            raise BadInput(f"{option} = {setting}: must be NAME=VALUE, such as viscosity=1e4") from None
    return values
