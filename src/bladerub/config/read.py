"""The configuration: read, merged, and checked before anything is computed.

`read` lays YAML files over one another as Snakemake does and checks the result; it reports every problem in
one line that names the location, the key, the value and what would be right.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from bladerub.config import files, schema
from bladerub.config.errors import UNKNOWN, ConfigError, Location, Problem, top_key


def load(*paths: str | Path) -> dict[str, Any]:
    """Read YAML files, each laid over those before it, without a check of what they hold.

    Raises
    ------
    ConfigError
        As for `bladerub.config.files.compose`.
    """
    return files.compose(*paths).plain()


def read(*paths: str | Path, command_line: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Read a config and check it.

    Parameters
    ----------
    paths, command_line
        As for `bladerub.config.files.compose`.

    Raises
    ------
    ConfigError
        As for `bladerub.config.files.compose` and `validate`.
    """
    return validate_located(files.compose(*paths, command_line=command_line))


def validate_located(config: files.Located) -> dict[str, Any]:
    """Return the values of a config after a check.

    Raises
    ------
    ConfigError
        Every problem found, with the file and line of the value.
    """
    return validate(config.plain(), config.locations())


def validate(config: dict[str, Any], locations: Mapping[str, Location] | None = None) -> dict[str, Any]:
    """Check `config` against the schema and for what a schema cannot say.

    Parameters
    ----------
    config : dict
        As from `load`.
    locations : mapping of str to Location, optional
        From `bladerub.config.files.Located.locations`, to name the locations of the problems.

    Returns
    -------
    dict
        `config` itself.

    Raises
    ------
    ConfigError
        Every problem found, one line each: location, key, value and what would be right. What a schema cannot
        say is checked for those parts of the config that agree with the schema.
    """
    from bladerub.config.checks import check  # takes half a second to import, `bladerub --help` does without

    problems = list(schema.problems(config))
    missing = set(schema.schema()["required"]) - set(config)
    problems += check(config, missing | set(map(top_key, problems)))
    if problems:
        raise ConfigError(Problem(_location(text, locations or {}), text) for text in dict.fromkeys(problems))
    return config


def _location(problem: str, locations: Mapping[str, Location]) -> Location:
    """Find the location of the key that a problem begins with, or of its innermost known group."""
    ends = (match.start() for match in re.finditer(r"[ :.[]", problem))
    keys = [problem[:end] for end in ends if problem[:end] in locations]
    return locations[keys[-1]] if keys else UNKNOWN
