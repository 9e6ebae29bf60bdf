"""The reference of all keys of a config, docs/config.md, written from the schema and the study's values."""

from collections.abc import Iterator, Mapping
from typing import Any

from bladerub.config.schema import allowed, kinds
from bladerub.config.units import choices_by_kind

HEAD = """\
# Configuration

The values of the study are in `config/config.yaml`. A file of your own needs only the keys that it changes:
`snakemake -j2 --configfile my.yaml` lays it over the study. Mappings merge, a list is replaced as a whole. A
file can extend others (`extend`). Values given on the command line (`--config`) are laid over all files. `[]`
stands for each entry of a list, `<name>` for any name.

This page is made from `config/schema.yaml` and `config/config.yaml` by `snakemake -j1 docs/config.md`.

## Units

A number may be typed with its unit, in a config, on the command line and in Python. It is converted where
it is read; the same study in plain numbers has the same runs.

```yaml
speeds: {{start: 2000 rpm, stop: 4500 rpm, step: 50 rpm}}
contact: {{layer_thickness: 6 mm}}
coatings:
  - {{casing: 2nd, E: [300 MPa, 1.2 GPa], K: [300 MPa], theta: [8 deg]}}
```

| quantity | units |
|---|---|
{units}

The column `unit` of the tables below says what a plain number is in: f1 is the first frequency at rest,
modulus_unit is `contact.modulus_unit`.

* A speed in rpm is divided by the first frequency of the blade of the config, which is computed the first
  time, in a few seconds, and kept. It is rounded to nine digits, so that it does not depend on the machine.
* Speeds of a study have six decimals, about 0.01 rpm. Each speed of a grid in rpm is rounded by itself, so
  that `--f "5000 rpm"` is the run of a grid with 5000 rpm in it. `reduction.f_omega_max` is rounded up.
* E, K and `contact.yield_stress` in Pa are divided by `contact.modulus_unit`. `contact.scale` multiplies
  plain numbers alone: a quantity with a unit is what it says.
* A plan of rows of blades or rigs may have units, too; factors of a plan and what `sets` give them may not.

"""

Rule = Mapping[str, Any]


def reference(schema: Rule, config: Mapping[str, Any]) -> str:
    """Write the reference in Markdown: a section for each key at the top, a row for each key below it.

    `config` is the study, for the values that a config without that key has.
    """
    units_of_kinds = "\n".join(f"| {kind} | {names} |" for kind, names in choices_by_kind().items())
    sections = [HEAD.format(units=units_of_kinds)]
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
    for kind in kinds(entry_rule) if isinstance(entry_rule, Mapping) else ():
        yield from _keys(schema, f"{path}.<name>", kind, None)
    for kind in kinds(rule["items"]) if "items" in rule else ():
        yield from _keys(schema, f"{path}[]", kind, None)


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
