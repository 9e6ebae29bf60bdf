"""The reference of all keys of a config, docs/config.md, written from the schema and the study's values."""

from collections.abc import Iterator, Mapping
from typing import Any

from bladerub.config.schema import allowed

HEAD = """\
# Configuration

The values of the study are in `config/config.yaml`. A file of your own needs only the keys that it changes:
`snakemake -j2 --configfile my.yaml` lays it over the study. Mappings merge, a list is replaced as a whole. A
file can extend others (`extend`). Values given on the command line (`--config`) are laid over all files. `[]`
stands for each entry of a list, `<name>` for any name.

This page is made from `config/schema.yaml` and `config/config.yaml` by `snakemake -j1 docs/config.md`.
"""

Rule = Mapping[str, Any]


def reference(schema: Rule, config: Mapping[str, Any]) -> str:
    """Write the reference in Markdown: a section for each key at the top, a row for each key below it.

    `config` is the study, for the values that a config without that key has.
    """
    sections = [HEAD]
    for name, part in schema["properties"].items():
        keys = list(_keys(schema, name, part, config.get(name)))
        rows = [_row(*key) for key in keys if key[0] != name or len(keys) == 1]
        rows = list(dict.fromkeys(rows))  # kinds of entry have keys in common
        table = ["| key | what | unit | may be | in the study | why |", "|---|---|---|---|---|---|", *rows]
        sections.append("\n".join([f"## {name}", "", part["description"].strip(), "", *table, ""]))
    return "\n".join(sections)


def _keys(schema: Rule, path: str, rule: Rule, value: Any) -> Iterator[tuple[str, Rule, Any]]:
    """Yield path, rule and value of each key, the value None where the study has no single one."""
    if "$ref" in rule:
        rule = schema["$defs"][rule["$ref"].rsplit("/", 1)[1]]
    yield path, rule, None if isinstance(value, dict | list) else value
    for name, inner in rule.get("properties", {}).items():
        inside = value.get(name) if isinstance(value, dict) else None
        yield from _keys(schema, f"{path}.{name}", inner, inside)
    entry_rule = rule.get("additionalProperties")
    for kind in _kinds(entry_rule) if isinstance(entry_rule, Mapping) else ():
        yield from _keys(schema, f"{path}.<name>", kind, None)
    for kind in _kinds(rule["items"]) if "items" in rule else ():
        yield from _keys(schema, f"{path}[]", kind, None)


def _kinds(items: Rule) -> list[Rule]:
    """Return the kinds of entry that a list or group may have: those of its conditions, or the one it has."""
    return [branch["then"] for branch in items.get("allOf", []) if "then" in branch] or [items]


def _row(path: str, rule: Rule, value: Any) -> str:
    cells = (
        f"`{path}`",
        rule["title"],
        "" if rule["unit"] in ("none", "1") else rule["unit"],
        "; ".join([allowed(rule), *(limit.partition(",")[0] for limit in rule.get("limits", []))]),
        "" if value is None else f"`{value:g}`" if isinstance(value, float) else f"`{value}`",
        rule["description"],
    )
    return "| " + " | ".join(" ".join(str(cell).replace("|", "\\|").split()) for cell in cells) + " |"
