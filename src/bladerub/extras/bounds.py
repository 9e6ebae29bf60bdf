"""Whole numbers within bounds, as options of commands and as arguments of the Python interface."""

import argparse
import operator
from contextlib import suppress
from typing import Any

from bladerub.io.errors import BadInput, format_value


def require(options: argparse.Namespace, **bounds: tuple[int, int]) -> None:
    """Check options by name against their smallest and largest value; those not given pass."""
    for option, (smallest, largest) in bounds.items():
        value = getattr(options, option)
        if value is not None and not smallest <= value <= largest:
            raise BadInput(f"--{option} = {format_value(value)}: must be from {smallest} to {largest}")


def whole_number(name: str, value: Any, largest: int = 10_000) -> int:
    """Return the argument `name` if it is a whole number, also of numpy, from 1 to the `largest`."""
    from bladerub.api.arguments import InputError

    with suppress(TypeError):
        if not isinstance(value, bool) and 1 <= (number := operator.index(value)) <= largest:
            return number
    raise InputError(name, value, f"must be a whole number from 1 to {largest}")
