"""The configuration: read, merged, and checked before anything is computed.

`read` lays YAML files over one another as Snakemake does and checks the result; it reports every problem in
one line that names the location, the key, the value and what would be right.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema

from bladerub.config import files
from bladerub.config.errors import UNKNOWN, ConfigError, Location, Problem, format_value, key_path
from bladerub.io.sources import ROOT

SCHEMA = ROOT / "config" / "schema.yaml"


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


def validate_located(composed: files.Located) -> dict[str, Any]:
    """Return the values of a config that was read, after a check.

    Raises
    ------
    ConfigError
        Every problem found, with the file and line of the value.
    """
    return validate(composed.plain(), composed.locations())


@cache
def schema() -> dict[str, Any]:
    """Return the schema of the repository, with ``$ref`` left as they are.

    Raises
    ------
    ConfigError
        If it is not beside the package, that is if the package was not installed in place.
    """
    if not SCHEMA.is_file():
        raise ConfigError.at(UNKNOWN, f"{SCHEMA} is missing: install bladerub in place, pip install -e .")
    return load(SCHEMA)


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
    from bladerub.config.checks import check  # it needs the parts of the package that need this module

    errors = sorted(_validator().iter_errors(config), key=lambda error: [str(part) for part in error.path])
    problems = [line for error in errors for line in _describe(error)]
    broken = {str(error.path[0]) if error.path else "" for error in errors}
    problems += check(config, broken | (set(schema()["required"]) - set(config)))
    if problems:
        raise ConfigError(
            [Problem(_location(problem, locations or {}), problem) for problem in dict.fromkeys(problems)]
        )
    return config


def _location(problem: str, locations: Mapping[str, Location]) -> Location:
    """Find the location of the key that a problem begins with, or of its innermost known group."""
    ends = (match.start() for match in re.finditer(r"[ :.[]", problem))
    keys = [problem[:end] for end in ends if problem[:end] in locations]
    return locations[keys[-1]] if keys else UNKNOWN


@cache
def _validator() -> jsonschema.protocols.Validator:
    base = jsonschema.Draft202012Validator
    types = base.TYPE_CHECKER.redefine_many(
        {
            "number": lambda _, value: is_number(value),
            "integer": lambda _, value: is_number(value) and isinstance(value, int),
        }
    )
    return jsonschema.validators.extend(base, {"pattern": _pattern}, type_checker=types)(schema())


def _pattern(_: Any, pattern: str, value: Any, __: Any) -> Iterator[jsonschema.ValidationError]:
    """Match the whole text: ``$`` of a search lets a newline pass, which must not get into a file name."""
    if isinstance(value, str) and not re.fullmatch(pattern, value):
        yield jsonschema.ValidationError(f"{value!r} does not match {pattern!r}")


def is_number(value: Any) -> bool:
    """Tell whether `value` is a finite number; True and False are none in a config, unlike in Python."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < math.inf


def _describe(error: jsonschema.ValidationError) -> list[str]:
    """Turn one error of the schema into our lines."""
    parts, rule = list(error.absolute_path), error.schema
    if error.validator == "additionalProperties":
        known = rule["properties"]
        unknown = {key: value for key, value in error.instance.items() if key not in known}
        return [
            f"{key_path([*parts, key])} = {format_value(value)}: unknown key, {_nearest(parts, key, known)}"
            for key, value in unknown.items()
        ]
    if error.validator == "required":
        missing = [key for key in rule["required"] if key not in error.instance]
        return [f"{key_path([*parts, key])}: missing, {_right(rule['properties'][key])}" for key in missing]
    if "propertyNames" in error.absolute_schema_path:
        return [f"{key_path([*parts, error.instance])}: {_right(rule)}"]
    if error.validator == "uniqueItems":
        return [
            f"{key_path(parts)} = {format_value(error.instance)}: {rule['title']} must not name one twice"
        ]
    where = f"{key_path(parts)} = {format_value(error.instance)}" if parts else format_value(error.instance)
    problem = f"{where}: {_right(rule)}"
    has_digits = isinstance(error.instance, str) and re.match(r"\s*[-+.\d]", error.instance)
    if has_digits and rule["type"] in ("number", "integer"):
        problem += ", the number alone"
    return [problem]


def _nearest(parts: list[Any], key: Any, known: dict[str, Any]) -> str:
    close = get_close_matches(str(key), known, n=1)
    if close:
        return f"did you mean {key_path([*parts, close[0]])}?"
    return f"known here: {', '.join(known)}"


_KINDS = {
    "number": "a number",
    "integer": "a whole number",
    "string": "text",
    "array": "a list",
    "object": "a group of keys",
}


def _right(rule: dict[str, Any]) -> str:
    """Say what a value must be, from its entry in the schema."""
    if "$ref" in rule:
        rule = schema()["$defs"][rule["$ref"].rsplit("/", 1)[-1]]
    kind = rule.get("form") or _KINDS[rule["type"]]
    return f"{rule['title']} must be {kind}{_range(rule)}{_unit(rule)}"


def _unit(rule: dict[str, Any]) -> str:
    if rule["type"] == "integer" or rule["unit"] in ("none", "1"):
        return ""
    return " (normalised)" if rule["unit"] == "normalised" else f", in {rule['unit']}"


def _range(rule: dict[str, Any]) -> str:
    if rule["type"] == "object":
        if "maxProperties" not in rule:
            return ""
        return f" with {rule['minProperties']} to {rule['maxProperties']} of them"
    if rule["type"] == "array":
        fewest, most = rule.get("minItems", 0), rule.get("maxItems", math.inf)
        if most == math.inf:
            return f" of {fewest} or more entries"
        return f" of {fewest} entries" if fewest == most else f" of {fewest} to {most} entries"
    if {"minimum", "maximum"} <= rule.keys():
        return f" from {rule['minimum']:g} to {rule['maximum']:g}"
    words = {"exclusiveMinimum": "above", "minimum": "of at least"}
    words |= {"exclusiveMaximum": "below", "maximum": "at most"}
    bounds = [f"{word} {rule[bound]:g}" for bound, word in words.items() if bound in rule]
    return f" {' and '.join(bounds)}" if bounds else ""


def check_quantity(name: str, value: Any) -> None:
    """Check one value against the schema's definition of `name`, for instance ``E`` or ``f_omega``.

    Raises
    ------
    ValueError
        Says what would be right.
    """
    rule = schema()["$defs"][name]
    if any(_validator().evolve(schema=rule).iter_errors(value)):
        raise ValueError(_right(rule))
