"""The config as a JSON schema, for editors: ``bladerub config --schema``, config/schema.json."""

import json
from collections.abc import Iterator, Mapping
from typing import Any

from bladerub.config.models.study import whole

Rule = dict[str, Any]


def json_schema() -> Rule:
    """Make the JSON schema (draft 2020-12) of a file that is laid over the study.

    Such a file may leave out any key of a group, but not those of an entry of a list, which is replaced as a
    whole. What compares keys with each other is not in it.
    """
    schema = whole().model_json_schema()
    _tidy(schema, schema["$defs"], set(), is_laid_over=True)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def text() -> str:
    """Write the schema as in config/schema.json, a line for each section."""
    schema = json_schema()
    parts = {name: json.dumps(rule, ensure_ascii=False) for name, rule in schema.items()}
    for name in ("$defs", "properties"):
        lines = (f'  "{key}": {json.dumps(rule, ensure_ascii=False)}' for key, rule in schema[name].items())
        parts[name] = "{\n" + ",\n".join(lines) + "\n }"
    return "{\n" + ",\n".join(f' "{name}": {part}' for name, part in parts.items()) + "\n}\n"


def _tidy(rule: Rule, definitions: Mapping[str, Rule], done: set[str], is_laid_over: bool) -> None:
    """Leave out titles and defaults that say nothing, and keys that a group has where another is below it."""
    name = rule.get("$ref", "").rpartition("/")[2]
    if name and name not in done:
        done.add(name)
        _tidy(definitions[name], definitions, done, is_laid_over)
    rule.pop("title", None)
    if name or rule.get("default", ...) is None:
        rule.pop("default", None)
    if "description" in rule:
        rule["description"] = " ".join(rule["description"].split())
    if "patternProperties" in rule:
        rule["additionalProperties"] = False
    if is_laid_over:
        rule.pop("required", None)
        if "oneOf" in rule:
            rule["anyOf"] = rule.pop("oneOf")
    for inner in _inside(rule):
        _tidy(inner, definitions, done, is_laid_over)
    if "items" in rule:
        _tidy(rule["items"], definitions, done, is_laid_over=False)


def _inside(rule: Rule) -> Iterator[Rule]:
    for name in ("properties", "patternProperties"):
        yield from rule.get(name, {}).values()
    for name in ("anyOf", "oneOf"):
        yield from rule.get(name, [])
    if isinstance(rule.get("additionalProperties"), dict):
        yield rule["additionalProperties"]
