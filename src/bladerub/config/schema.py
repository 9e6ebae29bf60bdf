"""What the schema, ``config/schema.yaml``, says of a config, in words that name key, value and what is right.

Three keywords of the schema are ours. ``limits`` and ``keyOf`` compare a value with other keys of the config:
``limits: [at most contact.elements / 8, the tip of a blade is narrow]`` or ``keyOf: casings``; ``ascending``
asks each entry of a list to be above the one before.
"""

import operator
import re
import sys
from collections.abc import Iterator, Mapping
from difflib import get_close_matches
from functools import cache, reduce
from itertools import pairwise
from typing import Any

import jsonschema
import yaml

from bladerub.config import units
from bladerub.config.errors import format_value, key_path
from bladerub.config.files import yaml_reading
from bladerub.io.folders import ROOT

SCHEMA = ROOT / "config" / "schema.yaml"

_COMPARING = {"limits", "keyOf"}
_LIMIT = re.compile(r"(at most|below|at least|above) ([\w.]+)(?: / (\d+))?(?:, .+)?")
_RELATIONS = {"at most": operator.le, "below": operator.lt, "at least": operator.ge, "above": operator.gt}
_KINDS = {"number": "a number", "integer": "a whole number", "string": "text"}
_KINDS |= {"array": "a list", "object": "a group of keys", "boolean": "true or false"}


@cache
def schema() -> dict[str, Any]:
    """Return the schema, with ``$ref`` left as they are."""
    # by the C library where there is one: each start of the workflow waits for this, the largest of its files
    loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
    return yaml.load(SCHEMA.read_text(encoding="utf-8"), Loader=loader)


def problems(config: Mapping[str, Any], definition: str | None = None) -> Iterator[str]:
    """Yield a line for each problem, of a config or of what a `definition` of the schema describes.

    Values are compared with other keys if the schema allows both parts.
    """
    validator = _validator().evolve(schema=schema()["$defs"][definition]) if definition else _validator()
    errors = sorted(validator.iter_errors(config), key=lambda error: [str(part) for part in error.path])
    violations = [error for error in errors if error.validator not in _COMPARING]
    for error in violations:
        yield from _describe(error)
    broken = {error.path[0] if error.path else "" for error in violations}
    valid = {key: value for key, value in config.items() if key not in broken}
    for error in errors:
        if error.validator in _COMPARING and error.path[0] in valid:
            setting = f"{key_path(error.path)} = {format_value(error.instance)}"
            yield from (f"{setting}: must be {requirement}" for requirement in _compare(error, valid))


def resolved(rule: Mapping[str, Any]) -> Mapping[str, Any]:
    """Return the entry of the schema that ``$ref`` names, or `rule` if it has none."""
    if "$ref" not in rule:
        return rule
    return reduce(operator.getitem, rule["$ref"].split("/")[1:], schema())


def kinds(rule: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the kinds of entry that a list or group may have: those of its conditions, or the one it has."""
    return [branch["then"] for branch in rule.get("allOf", []) if "then" in branch] or [rule]


def inner(rule: Mapping[str, Any], key: str | None) -> Mapping[str, Any] | None:
    """Return the entry of the schema for what is under `key`, or in a list (None), where `rule` is of it all.

    None if the schema has none. Kinds of one list that share a key say the same of it.
    """
    for kind in kinds(rule):
        within = kind.get("items") if key is None else kind.get("properties", {}).get(key)
        within = within or (kind.get("additionalProperties") if key is not None else None)
        if isinstance(within, Mapping):
            return within
    return None


def check_quantity(name: str, value: Any) -> None:
    """Check one value against the schema's definition of `name`, for instance ``E`` or ``f_omega``.

    Raises
    ------
    ValueError
        Says what would be right.
    """
    rule = schema()["$defs"][name]
    errors = _validator().evolve(schema=rule).iter_errors(value)
    if any(error.validator not in _COMPARING for error in errors):
        raise ValueError(_typed(value, rule))


def is_number(value: Any) -> bool:
    """Return whether `value` is a finite number; True and False are none in a config, unlike in Python."""
    is_one = isinstance(value, int | float) and not isinstance(value, bool)
    return is_one and abs(value) <= sys.float_info.max  # a whole number may be above


@cache
def _validator() -> jsonschema.protocols.Validator:
    base = jsonschema.Draft202012Validator
    types = base.TYPE_CHECKER.redefine_many(
        {
            "number": lambda _, value: is_number(value),
            "integer": lambda _, value: is_number(value) and isinstance(value, int),
        }
    )
    keywords = {"pattern": _pattern, "ascending": _ascending} | dict.fromkeys(_COMPARING, _to_compare)
    return jsonschema.validators.extend(base, keywords, type_checker=types)(schema())


def _pattern(_: Any, pattern: str, value: Any, __: Any) -> Iterator[jsonschema.ValidationError]:
    """Match the whole text: ``$`` of a search lets a newline pass, which must not get into a file name."""
    if isinstance(value, str) and not re.fullmatch(pattern, value):
        yield jsonschema.ValidationError(f"{value!r} does not match {pattern!r}")


def _ascending(_: Any, __: Any, values: Any, ___: Any) -> Iterator[jsonschema.ValidationError]:
    if isinstance(values, list) and all(map(is_number, values)):
        for index, (lower, upper) in enumerate(pairwise(values), 1):
            if float(f"{upper:g}") <= float(f"{lower:g}"):  # six digits, as in the names of files
                requirement = f"above the one before ({lower:g})"
                yield jsonschema.ValidationError(requirement, path=[index], instance=upper)


def _to_compare(_: Any, __: Any, ___: Any, ____: Any) -> Iterator[jsonschema.ValidationError]:
    """Yield what `problems` is to compare: a keyword does not see the other keys."""
    yield jsonschema.ValidationError("")


def _compare(error: jsonschema.ValidationError, config: Mapping[str, Any]) -> Iterator[str]:
    """Yield what would be right, for each comparison of ``keyOf`` or ``limits`` that fails."""
    if error.validator == "keyOf":
        names = config.get(error.validator_value, {error.instance})
        if error.instance not in names:
            yield f"one of the {error.validator_value}, {', '.join(names)}"
        return
    for limit in error.validator_value:
        relation, key, divisor = _LIMIT.fullmatch(limit).groups()
        bound: Any = config
        for part in key.split("."):
            bound = bound.get(part, {})
        if is_number(bound) and not _RELATIONS[relation](error.instance, bound / int(divisor or 1)):
            condition, comma, reason = limit.partition(",")
            yield f"{condition} = {bound / int(divisor or 1):g}{comma}{reason}"


def _describe(error: jsonschema.ValidationError) -> list[str]:
    """Turn one error of the schema into our lines."""
    parts, rule = list(error.absolute_path), error.schema
    setting = f"{key_path(parts)} = {format_value(error.instance)}" if parts else format_value(error.instance)
    if error.validator == "additionalProperties":
        fields = rule["properties"]
        unknown = {key: value for key, value in error.instance.items() if key not in fields}
        return [
            f"{key_path([*parts, key])} = {format_value(value)}: unknown key, {_nearest(parts, key, fields)}"
            for key, value in unknown.items()
        ]
    if error.validator == "required":
        missing = [key for key in rule["required"] if key not in error.instance]
        new = "" if parts else " (a config of an older version? `bladerub new` writes one that has it)"
        return [
            f"{key_path([*parts, key])}: missing, {_right(rule['properties'][key])}{new}" for key in missing
        ]
    if "propertyNames" in error.absolute_schema_path:
        return [f"{key_path([*parts, error.instance])}: {_right(rule)}"]
    if error.validator == "uniqueItems":
        return [f"{setting}: {rule['title']} must not name one twice"]
    if error.validator == "ascending":
        return [f"{setting}: must be {error.message}"]
    return [f"{setting}: {_typed(error.instance, rule)}"]


def _typed(value: Any, rule: dict[str, Any]) -> str:
    """Say what is wrong with a value: another kind of quantity, another unit than is meant, or its size."""
    if rule["type"] not in ("number", "integer"):
        return _right(rule)
    if is_number(value):
        meant = units.meant(value, rule)
        return f"{_right(rule)}{f'; this {meant}' if meant else ''}"
    if isinstance(value, str) and (reading := yaml_reading(value)):
        return f"{_right(rule)} (YAML reads this as {reading})"
    if quantity := units.read(value):
        try:
            units.convert(quantity, rule, lambda name: 1.0)
        except ValueError as error:
            return str(error)
        return f"needs {units.needs(rule)} of this study, which is not known; {_right(rule)}"
    return _right(rule)


def _nearest(parts: list[Any], key: Any, fields: dict[str, Any]) -> str:
    close = get_close_matches(str(key), fields, n=1)
    return f"did you mean {key_path([*parts, close[0]])}?" if close else f"known here: {', '.join(fields)}"


def _right(rule: dict[str, Any]) -> str:
    """Say what a value must be, from its entry in the schema."""
    rule = resolved(rule)
    return f"{rule['title']} must be {allowed(rule)}{units.in_words(rule)}"


def allowed(rule: Mapping[str, Any]) -> str:
    """Say kind and range of the values that an entry of the schema allows, ``a number from 0.01 to 3``."""
    kind = rule.get("form") or _KINDS[rule["type"]]
    if "maxProperties" in rule:
        return f"{kind} with {rule['minProperties']} to {rule['maxProperties']} of them"
    if rule["type"] == "array":
        minimum, maximum = rule.get("minItems", 0), rule["maxItems"]
        order = ", ascending" if "ascending" in rule else ""
        return f"{kind} of {minimum if minimum == maximum else f'{minimum} to {maximum}'} entries{order}"
    if {"minimum", "maximum"} <= rule.keys():
        return f"{kind} from {rule['minimum']:g} to {rule['maximum']:g}"
    words = {"exclusiveMinimum": "above", "minimum": "of at least"}
    words |= {"exclusiveMaximum": "below", "maximum": "at most"}
    bounds = [f"{word} {rule[bound]:g}" for bound, word in words.items() if bound in rule]
    return f"{kind} {' and '.join(bounds)}".rstrip()
