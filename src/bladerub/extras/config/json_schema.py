"""The config as a JSON schema, for editors: ``bladerub config --schema``, config/schema.json."""

import json
import re
from typing import Any

from bladerub.config.keys import Key, key_of
from bladerub.settings.study import whole
from bladerub.settings.units import NUMBER, UNITS

Rule = dict[str, Any]

_BOUNDS = {"ge": "minimum", "gt": "exclusiveMinimum", "le": "maximum", "lt": "exclusiveMaximum"}
_TYPES = {"a number": "number", "a whole number": "integer", "text": "string", "true or false": "boolean"}


def json_schema() -> Rule:
    """Make the JSON schema (draft 2020-12) of a file that is laid over the study; it compares no keys.

    Such a file may leave out any key of a group, but none of an entry of a list, which is replaced whole.
    """
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **_rule(key_of(whole()), True)}


def text() -> str:
    """Write the schema as in config/schema.json, a line for each section."""
    schema = json_schema()
    parts = {name: json.dumps(rule, ensure_ascii=False) for name, rule in schema.items()}
    lines = (
        f'  "{key}": {json.dumps(rule, ensure_ascii=False)}' for key, rule in schema["properties"].items()
    )
    parts["properties"] = "{\n" + ",\n".join(lines) + "\n }"
    return "{\n" + ",\n".join(f' "{name}": {part}' for name, part in parts.items()) + "\n}\n"


def _rule(key: Key, is_laid_over: bool) -> Rule:
    """Make the schema of what is below a key, which is perhaps laid over what is there."""
    rule: Rule = {"description": key.description} if key.description else {}
    fewest, most = key.sizes
    if key.kind == "a list":
        entry = _rule(key.entry, is_laid_over=False)
        sizes = {"minItems": fewest} | ({} if most is None else {"maxItems": most})
        sizes |= {"uniqueItems": True} if key.is_unique else {}
        return rule | {"type": "array", "items": entry, **sizes}
    if key.kind == "a group of keys":
        return rule | _group(key, is_laid_over)
    value: Rule = {"type": _TYPES[key.kind]}
    value |= {_BOUNDS[name]: bound for name, bound in key.bounds.items()}
    further = {"enum": list(key.choices) or None, "pattern": key.pattern or None, "maxLength": most}
    value |= {name: setting for name, setting in further.items() if setting is not None}
    return rule | ({"anyOf": [value, _quantity(key)]} if key.kind == "a number" else value)


def _group(key: Key, is_laid_over: bool) -> Rule:
    if key.names:
        fewest, most = key.sizes
        names = {name: value for name, value in _rule(key.names, False).items() if name != "description"}
        sizes = {"minProperties": fewest} | ({} if most is None else {"maxProperties": most})
        entry = _rule(key.entry, is_laid_over)
        return {"type": "object", "propertyNames": names, "additionalProperties": entry, **sizes}
    kinds = []
    for model in key.models.values():
        below = {name: _rule(inner, is_laid_over) for name, inner in key_of(model).fields().items()}
        others = _rule(key.entry, is_laid_over) if key.entry else False
        rule = {"type": "object", "properties": below, "additionalProperties": others}
        required = [name for name, field in model.model_fields.items() if field.is_required()]
        kinds.append(rule if is_laid_over or not required else rule | {"required": required})
    return kinds[0] if len(kinds) == 1 else {"anyOf": kinds}


def _quantity(key: Key) -> Rule:
    """Allow text that is a number with a unit."""
    kinds = [kind for kind in (key.unit.kind, "share" if key.is_share else "") if kind]
    kinds = list(UNITS) if key.unit.name == "SI" else kinds
    names = "|".join(re.escape(name) for kind in kinds for name in UNITS[kind])
    return {"type": "string", "pattern": rf"^\s*{NUMBER}\s*({names})\s*$"}
