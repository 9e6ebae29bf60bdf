"""Faults of a config: where each is, and how it is told."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any, NamedTuple

from bladerub.io.errors import BadInput

_MOST_LINES = 40
"""Faults that are told; who has more will mend these first."""


class Place(NamedTuple):
    """Where a value of a config comes from.

    Parameters
    ----------
    source : str
        A file, ``--config`` for the command line, ``config`` where nothing more is known.
    line : int, optional
        Counted from 1; 0 if there are no lines.
    """

    source: str
    line: int = 0

    def __str__(self) -> str:
        return f"{self.source}:{self.line}" if self.line else self.source


UNKNOWN = Place("config")


class Fault(NamedTuple):
    """What is wrong, and where.

    Parameters
    ----------
    place : Place
        The file and line, as far as they are known.
    text : str
        Key, value and what would be right: ``coatings[1].E[0] = -1: Young modulus must be ...``.
    """

    place: Place
    text: str

    def __str__(self) -> str:
        return f"{self.place}: {self.text}"


class ConfigError(BadInput):
    """One or more faults of a configuration, one line each."""

    def __init__(self, faults: Iterable[Fault]):
        self.faults = list(faults)
        lines = [str(fault) for fault in self.faults[:_MOST_LINES]]
        if len(self.faults) > _MOST_LINES:
            lines.append(f"config: and {len(self.faults) - _MOST_LINES} faults more")
        super().__init__("\n".join(lines))


def key_path(parts: Iterable[Any]) -> str:
    """Write a path into the config as ``coatings[1].E[0]``, a key that is no plain word in quotes."""
    text = ""
    for part in parts:
        plain = isinstance(part, str) and re.fullmatch(r"\w{1,60}", part)
        text += f"{'.' if text else ''}{part}" if plain else f"[{shown(part)}]"
    return text


def shown(value: Any) -> str:
    """Write a value of the config on one short line of printable characters."""
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    text = "".join(char if char.isprintable() else " " for char in text)
    text = " ".join(text.split())
    return text if len(text) <= 60 else text[:57] + "..."
