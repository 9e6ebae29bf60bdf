"""The configuration: read, merged, and checked before anything is computed.

`load` reads YAML files and lays them over one another as Snakemake does; `validate` answers every fault
with one line that names the key, the value and what would be right.
"""

from __future__ import annotations

import copy
import math
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from difflib import get_close_matches
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import yaml

ROOT = Path(__file__).resolve().parents[2]
"""The repository: the package is installed from it in place (``pip install -e .``)."""

SCHEMA = ROOT / "config" / "schema.yaml"


class ConfigError(ValueError):
    """One or more faults of a configuration, one line each."""

    def __init__(self, faults: list[str]):
        super().__init__("\n".join(f"config: {fault}" for fault in faults))
        self.faults = faults


@contextmanager
def faults_end_the_program() -> Iterator[None]:
    """Turn a `ConfigError` into its lines on standard error and exit code 2, without a traceback."""
    try:
        yield
    except ConfigError as error:
        print(error, file=sys.stderr)
        sys.exit(2)


class _UniqueKeyLoader(yaml.SafeLoader):
    """YAML's safe loader, but a key given twice is a fault, not silently the last one."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict:
        seen = set()
        for key_node, _ in node.value:
            key = self.construct_object(key_node, deep=True)
            if not isinstance(key, str | int | float):
                raise yaml.MarkedYAMLError(problem="a key must be text", problem_mark=key_node.start_mark)
            if key in seen:
                raise yaml.MarkedYAMLError(problem=f"{key} is given twice", problem_mark=key_node.start_mark)
            seen.add(key)
        return super().construct_mapping(node, deep)


def load(*paths: str | Path) -> dict[str, Any]:
    """Read YAML files, each laid over those before it: mappings merge, all else is replaced.

    Raises
    ------
    ConfigError
        If a file is missing, is not YAML or is not a mapping; names the file and the line.
    """
    config: dict[str, Any] = {}
    for path in paths:
        lay_over(config, _read(Path(path)))
    return read_numbers(config)


def _read(path: Path) -> dict[str, Any]:
    try:
        content = yaml.load(path.read_text(encoding="utf-8"), Loader=_UniqueKeyLoader)
    except OSError as error:
        raise ConfigError([f"{path}: cannot be read ({error.strerror})"]) from error
    except UnicodeDecodeError as error:
        raise ConfigError([f"{path}: is not text in UTF-8"]) from error
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        line = f", line {mark.line + 1}" if mark else ""
        problem = getattr(error, "problem", None) or str(error).splitlines()[0]
        raise ConfigError([f"{path}{line}: not valid YAML ({problem})"]) from error
    if not isinstance(content, dict):
        raise ConfigError([f"{path}: must hold keys at its top level, such as those of config/config.yaml"])
    return content


def lay_over(base: dict[str, Any], overlay: Mapping[str, Any]) -> None:
    """Change `base` by what `overlay` holds: mappings merge, all else is replaced."""
    for key, value in overlay.items():
        if isinstance(value, dict) and isinstance(base.get(key), dict):
            lay_over(base[key], value)
        else:
            base[key] = value


_NUMBER = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+")


def read_numbers(value: Any) -> Any:
    """Return a copy of `value` with numbers such as 1e-3 as floats: YAML 1.1 leaves them as text."""
    if isinstance(value, dict):
        return {key: read_numbers(entry) for key, entry in value.items()}
    if isinstance(value, list):
        return [read_numbers(entry) for entry in value]
    if isinstance(value, str) and _NUMBER.fullmatch(value):
        return float(value)
    return copy.copy(value)


@cache
def schema() -> dict[str, Any]:
    """Return the schema of the repository, with ``$ref`` left as they are.

    Raises
    ------
    ConfigError
        If it is not beside the package, that is if the package was not installed in place.
    """
    if not SCHEMA.is_file():
        raise ConfigError([f"{SCHEMA} is missing: install bladerub in place, pip install -e ."])
    return _read(SCHEMA)


def validate(config: dict[str, Any]) -> dict[str, Any]:
    """Check `config` against the schema and for what a schema cannot say.

    Parameters
    ----------
    config : dict
        As from `load` or from Snakemake.

    Returns
    -------
    dict
        A copy with all numbers read as numbers.

    Raises
    ------
    ConfigError
        Every fault found, one line each: key, value and what would be right. What a schema cannot say is
        checked for those parts of the config that agree with the schema.
    """
    from bladerub.config_checks import check  # it needs the parts of the package that need this module

    config = read_numbers(config)
    errors = sorted(_validator().iter_errors(config), key=lambda error: [str(part) for part in error.path])
    faults = [line for error in errors for line in _describe(error)]
    broken = {str(error.path[0]) if error.path else "" for error in errors}
    faults += check(config, broken | (set(schema()["required"]) - set(config)))
    if faults:
        raise ConfigError(list(dict.fromkeys(faults)))
    return config


@cache
def _validator() -> jsonschema.protocols.Validator:
    base = jsonschema.Draft202012Validator
    types = base.TYPE_CHECKER.redefine_many(
        {
            "number": lambda _, value: _is_number(value) and abs(value) < math.inf,
            "integer": lambda _, value: _is_number(value) and isinstance(value, int),
        }
    )
    return jsonschema.validators.extend(base, type_checker=types)(schema())


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def key_path(parts: list[Any]) -> str:
    """Write a path into the config as ``coatings[1].E[0]``, a key that is no plain word in quotes."""
    text = ""
    for part in parts:
        plain = isinstance(part, str) and re.fullmatch(r"\w+", part)
        text += f"{'.' if text else ''}{part}" if plain else f"[{shown(part)}]"
    return text


def shown(value: Any) -> str:
    """Write a value of the config on one short line."""
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    text = " ".join(text.split())
    return text if len(text) <= 60 else text[:57] + "..."


def _describe(error: jsonschema.ValidationError) -> list[str]:
    """Turn one error of the schema into our lines."""
    parts, rule = list(error.absolute_path), error.schema
    if error.validator == "additionalProperties":
        known = rule["properties"]
        unknown = {key: value for key, value in error.instance.items() if key not in known}
        return [
            f"{key_path([*parts, key])} = {shown(value)}: unknown key, {_nearest(parts, key, known)}"
            for key, value in unknown.items()
        ]
    if error.validator in ("required", "dependentRequired"):
        missing = [key for key in _required(rule, error.instance) if key not in error.instance]
        return [f"{key_path([*parts, key])}: missing, {_right(rule['properties'][key])}" for key in missing]
    if error.validator == "pattern" and "propertyNames" in error.absolute_schema_path:
        return [f"{key_path([*parts, error.instance])}: {_right(rule)}"]
    if error.validator == "uniqueItems":
        return [f"{key_path(parts)} = {shown(error.instance)}: {rule['title']} must not name one twice"]
    where = f"{key_path(parts)} = {shown(error.instance)}" if parts else shown(error.instance)
    fault = f"{where}: {_right(rule)}"
    has_digits = isinstance(error.instance, str) and re.match(r"\s*[-+.\d]", error.instance)
    if has_digits and rule["type"] in ("number", "integer"):
        fault += ", the number alone"
    return [fault]


def _required(rule: dict[str, Any], entry: dict[str, Any]) -> list[str]:
    needs = rule.get("dependentRequired", {})
    return [*rule.get("required", []), *(need for key in needs if key in entry for need in needs[key])]


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
        return f" with at least {rule['minProperties']}" if "minProperties" in rule else ""
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
