"""The reference of all keys of a config, docs/config.md, written from the schema and the study's values."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

HEAD = """\
# What a config may hold

Made from `config/schema.yaml` and `config/config.yaml` by `snakemake -j1 docs/config.md`. A file of your own
needs only the keys that it changes: `snakemake -j2 --configfile my.yaml` lays it over the study.
Mappings merge, a list is replaced as a whole. A file can begin from others with `extend`; what is said on the
command line, `--config`, goes over all files. `[]` stands for each entry of a list, `<name>` for any name.
"""

_ENDS = {"minimum": "≥ {:g}", "exclusiveMinimum": "> {:g}", "maximum": "≤ {:g}", "exclusiveMaximum": "< {:g}"}
_COUNTS = {
    "minItems": "≥ {} entries",
    "maxItems": "≤ {} entries",
    "minProperties": "≥ {} names",
    "maxProperties": "≤ {} names",
}
_NO_VALUE = object()


class Key(NamedTuple):
    """One key as the reference shows it.

    Parameters
    ----------
    path : str
        Where it is, for instance ``casings.<name>.weights[]``.
    about : mapping
        Its part of the schema, references resolved.
    value : object
        What the study has there; `None` if it is no single value.
    """

    path: str
    about: Mapping[str, Any]
    value: Any


def reference(schema: Mapping[str, Any], config: Mapping[str, Any]) -> str:
    """Write the reference in Markdown: a section for each key at the top, a row for each key below it.

    Parameters
    ----------
    schema : mapping
        ``config/schema.yaml``.
    config : mapping
        The study, for the values that a config without that key has.
    """
    sections = [HEAD]
    for name, part in schema["properties"].items():
        keys = list(_keys(schema, name, part, config.get(name, _NO_VALUE)))
        rows = [_row(key) for key in keys if key.path != name or len(keys) == 1]
        rows = list(dict.fromkeys(rows))  # kinds of entry have keys in common
        table = ["| key | what | unit | may be | in the study | why |", "|---|---|---|---|---|---|", *rows]
        sections.append("\n".join([f"## {name}", "", part["description"].strip(), "", *table, ""]))
    return "\n".join(sections)


def _keys(schema: Mapping[str, Any], path: str, part: Mapping[str, Any], value: Any) -> Iterator[Key]:
    part = _resolved(schema, part)
    yield Key(path, part, None if isinstance(value, dict | list) or value is _NO_VALUE else value)
    for name, inner in part.get("properties", {}).items():
        inside = value.get(name, _NO_VALUE) if isinstance(value, Mapping) else _NO_VALUE
        yield from _keys(schema, f"{path}.{name}", inner, inside)
    named = part.get("additionalProperties")
    if isinstance(named, Mapping):
        yield from _keys(schema, f"{path}.<name>", named, _NO_VALUE)
    if "items" in part:
        for kind in _kinds(part["items"]):
            yield from _keys(schema, f"{path}[]", kind, _NO_VALUE)


def _resolved(schema: Mapping[str, Any], part: Mapping[str, Any]) -> Mapping[str, Any]:
    if "$ref" not in part:
        return part
    return schema["$defs"][part["$ref"].rsplit("/", 1)[1]]


def _kinds(items: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the kinds of entry that a list may have: those of its conditions, or the one it has."""
    return [branch["then"] for branch in items.get("allOf", []) if "then" in branch] or [items]


def _row(key: Key) -> str:
    about = key.about
    cells = (
        f"`{key.path}`",
        about["title"],
        "" if about["unit"] in ("none", "1") else about["unit"],
        _range(about),
        "" if key.value is None else f"`{_shown(key.value)}`",
        about["description"],
    )
    return "| " + " | ".join(" ".join(str(cell).replace("|", "\\|").split()) for cell in cells) + " |"


def _range(about: Mapping[str, Any]) -> str:
    if "form" in about:
        return about["form"]
    limits = [
        text.format(about[name])
        for texts in (_ENDS, _COUNTS)
        for name, text in texts.items()
        if name in about
    ]
    kind = {"integer": "a whole number"}.get(about.get("type"), "")
    return ", ".join(part for part in (kind, *limits) if part)


def _shown(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)
