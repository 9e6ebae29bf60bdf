"""The page of all keys of a config, docs/config.md, written from the models and the study's values."""

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from bladerub.config.keys import Key, key_of
from bladerub.settings.study import whole
from bladerub.settings.units import choices_by_kind

_LONG = 60  # letters of a description that is written once
PAGE = Path(__file__).parent / "config.md"
MARK = "<!-- written by `snakemake config_reference` from here on -->\n"


def updated(page: str, config: Mapping[str, Any]) -> str:
    """Return the page with today's units, and a section for each key at the top of the study's `config`."""
    sections = [f"| {kind} | {names} |" for kind, names in choices_by_kind().items()]
    described: dict[str, str] = {}
    for name, key in key_of(whole()).fields().items():
        lines = [_line(*keys, described) for keys in _keys(name, key, config.get(name))]
        sections += ["", f"## {name}", "", key.description, "", *lines]
    return "\n".join([page.partition(MARK)[0] + MARK, "| quantity | units |", "|---|---|", *sections, ""])


def _keys(path: str, key: Key, value: Any) -> Iterator[tuple[str, Key, Any]]:
    """Yield each key at and below a path with its value, which is None where the study has no single one."""
    entry = key.entry if key.kind == "a list" else None
    is_plain = entry and not (entry.models or entry.entry)
    if "." in path or "[" in path or not (key.fields() or key.entry) or is_plain:
        yield path, key, value
    for name, inner in key.fields().items():
        below = value.get(name) if isinstance(value, Mapping) else None
        yield from _keys(f"{path}.{name}", inner, below)
    if key.entry and not is_plain:
        yield from _keys(f"{path}[]" if entry else f"{path}.<name>", key.entry, None)


def _line(path: str, key: Key, value: Any, described: dict[str, str]) -> str:
    """Write the line of a key; a long description that another key has is said there alone."""
    text = key.description if "." in path or "[" in path else ""  # of a section, above its lines
    before = described.setdefault(text, path)
    if before != path and len(text) > _LONG:
        text = f"as `{before}`."
    shown, allowed = _value(value), _allowed(key)
    parts = [f"* `{path}`", f"= {shown}" if shown else "", f"({allowed})" if allowed else ""]
    return " ".join(" ".join(filter(None, parts)).split()) + (f": {text}" if text else "")


def _allowed(key: Key) -> str:
    """Say what is allowed, with the unit: ``0.01 to 5 m``, ``2 to 50 entries``; nothing for a group."""
    if key.models and key.kind != "a list":
        return ""
    allowed, unit, limits = key.allowed(), key.unit.name, key.limits
    if key.entry and key.kind == "a list":
        allowed = allowed.removeprefix("a list of ")
        if not key.entry.models:
            allowed += f", each {_bounds(key.entry.allowed())}"
            unit, limits = key.entry.unit.name, (*limits, *key.entry.limits)
    return "; ".join([_bounds(allowed) + ("" if unit == "1" else f" {unit}"), *map(str, limits)])


def _bounds(allowed: str) -> str:
    """Leave out of ``a number from 0 to 1`` what its bounds say."""
    for kind, short in (("a number ", ""), ("a whole number ", "whole, ")):
        if allowed.startswith(kind):
            return short + allowed.removeprefix(kind).removeprefix("from ").removeprefix("of ")
    return allowed


def _value(value: Any) -> str:
    if value is None or isinstance(value, Mapping):
        return ""
    if isinstance(value, list):
        is_short = value and not isinstance(value[0], Mapping) and len(value) < 10
        return f"`[{', '.join(map(_plain, value))}]`" if is_short else ""
    return f"`{_plain(value)}`"


def _plain(value: Any) -> str:
    if isinstance(value, float):
        return f"{value:g}"
    return str(value).lower() if isinstance(value, bool) else str(value)
