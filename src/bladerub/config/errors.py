"""Problems of a config: where each is, and the line that reports it."""

import re
from collections.abc import Iterable
from typing import Any, NamedTuple

from bladerub.io.errors import BadInput, format_value

_MOST_REPORTED = 40


class Location(NamedTuple):
    """Where a value comes from: a file (or ``--config``) and the line, counted from 1, or 0 for none."""

    source: str
    line: int = 0

    def __str__(self) -> str:
        return f"{self.source}:{self.line}" if self.line else self.source


UNKNOWN = Location("config")


class Problem(NamedTuple):
    """A location, and key, value and what would be right: ``coatings[1].E[0] = -1: must be ...``."""

    location: Location
    text: str

    def __str__(self) -> str:
        return f"{self.location}: {self.text}"


class ConfigError(BadInput):
    """One or more problems of a configuration, one line each; ``problems`` has location and text of each.

    Examples
    --------
    >>> import bladerub as br
    >>> try:
    ...     br.load_study("missing.yaml")
    ... except br.ConfigError as error:
    ...     print(len(error.problems))
    1
    """

    def __init__(self, problems: Iterable[Problem]):
        self.problems = list(problems)
        lines = [str(problem) for problem in self.problems[:_MOST_REPORTED]]
        if len(self.problems) > _MOST_REPORTED:
            lines.append(f"config: and {len(self.problems) - _MOST_REPORTED} problems more")
        super().__init__("\n".join(lines))

    @classmethod
    def at(cls, location: Location, text: str) -> "ConfigError":
        """Make the error of a single problem."""
        return cls([Problem(location, text)])


def key_path(parts: Iterable[Any]) -> str:
    """Write a path into the config as ``coatings[1].E[0]``, a key that is no plain word in quotes."""
    text = ""
    for part in parts:
        plain = isinstance(part, str) and re.fullmatch(r"\w{1,60}", part)
        text += f"{'.' if text else ''}{part}" if plain else f"[{format_value(part)}]"
    return text


def top_key(problem: str) -> str:
    """Return the key at the top of the config that the text of a problem begins with."""
    return re.findall(r"^\w*", problem)[0]
