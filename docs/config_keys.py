"""The page of all keys of a config, docs/config.md, written from the models and the study's values."""

from collections.abc import Iterator, Mapping
from typing import Any

from bladerub.config.keys import Key, key_of
from bladerub.config.models.study import whole
from bladerub.config.units import choices_by_kind

HEAD = """\
# Configuration

The values of the study are in `config/config.yaml`. A file of your own needs only the keys that it changes:
`snakemake -j2 --configfile my.yaml` lays it over the study, and each further file over those before. Mappings
merge, a list is replaced as a whole. Values given on the command line (`--config`) are laid over all files.
`[]` stands for each entry of a list, `<name>` for any name. A section that `config/config.yaml` does not
have, such as `chart`, belongs to a further study: its values are those of the last column, and a file may
change them as any others.

`bladerub config my.yaml` checks a file. Editors that know YAML schemas check it as you type with
`# yaml-language-server: $schema=config/schema.json` in its first line.

This page and `config/schema.json` are made from the models in `src/bladerub/config/models/` and the
`settings.py` of extras by `snakemake -j1 docs/config.md`.

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


def reference(config: Mapping[str, Any]) -> str:
    """Write the reference in Markdown: a section for each key at the top, a row for each key below it.

    `config` is the study, for the values that a config without that key has.
    """
    units_of_kinds = "\n".join(f"| {kind} | {names} |" for kind, names in choices_by_kind().items())
    sections = [HEAD.format(units=units_of_kinds)]
    for name, key in key_of(whole()).fields().items():
        rows = _rows(name, key, config.get(name))
        table = ["| key | what | unit | may be | in the study |", "|---|---|---|---|---|", *rows]
        sections.append("\n".join([f"## {name}", "", key.description, "", *table, ""]))
    return "\n".join(sections)


def _rows(path: str, key: Key, value: Any) -> Iterator[str]:
    """Write a row for each key at and below a path; `value` is None where the study has no single one."""
    entry = key.entry if key.kind == "a list" else None
    is_plain = entry and not (entry.models or entry.entry)
    if "." in path or "[" in path or not (key.fields() or key.entry) or is_plain:
        yield _row(path, key, value)
    for name, inner in key.fields().items():
        below = value.get(name) if isinstance(value, Mapping) else None
        yield from _rows(f"{path}.{name}", inner, below)
    if key.entry and not is_plain:
        yield from _rows(f"{path}[]" if entry else f"{path}.<name>", key.entry, None)


def _row(path: str, key: Key, value: Any) -> str:
    may_be = [key.allowed(), *map(str, key.limits)]
    unit = key.unit.name
    if key.entry and key.kind == "a list":
        may_be += [] if key.entry.models else [f"each {key.entry.allowed()}", *map(str, key.entry.limits)]
        unit = key.entry.unit.name
    cells = (
        f"`{path}`",
        key.description,
        "" if unit == "1" else unit,
        "; ".join(may_be),
        _value(value),
    )
    return "| " + " | ".join(" ".join(cell.replace("|", "\\|").split()) for cell in cells) + " |"


def _value(value: Any) -> str:
    if value is None or isinstance(value, Mapping):
        return ""
    if isinstance(value, list):
        is_short = value and not isinstance(value[0], Mapping) and len(value) < 10
        return f"`[{', '.join(map(_plain, value))}]`" if is_short else ""
    return f"`{_plain(value)}`"


def _plain(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return f"{value:g}" if isinstance(value, float) else str(value)
