"""What the models say of a config, in lines that name key, value and what is right."""

import json
import operator
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from difflib import get_close_matches
from functools import cache
from typing import Any

from pydantic import TypeAdapter, ValidationError

from bladerub.config.errors import key_path, top_key
from bladerub.config.files import decimal_form, yaml_reading
from bladerub.config.keys import NUMBERS, Key, key_of
from bladerub.io.errors import format_value
from bladerub.settings import units
from bladerub.settings.fields import OWN
from bladerub.settings.study import whole

NOT_KNOWN = "of this study, which is not known"  # in what follows from a problem of the keys of a reference
_RELATIONS = {"at most": operator.le, "below": operator.lt, "at least": operator.ge, "above": operator.gt}


def problems(
    values: Mapping[str, Any], kind: Any = None, study: Mapping[str, Any] | None = None
) -> Iterator[str]:
    """Yield a line for each problem of a config, or of the values of another model, `kind`, for a `study`.

    Numbers that other keys limit are compared where both parts of the config are as they must be.
    """
    kind = kind or whole()
    key, mistakes = _key(kind), []
    try:
        _adapter(kind).validate_python(values)
    except ValidationError as error:
        mistakes = error.errors(include_url=False)
    lines = sorted({_line(mistake, key, values) for mistake in mistakes})
    yield from lines
    broken = set(map(top_key, lines))
    valid = {name: value for name, value in values.items() if name not in broken}
    yield from _compared(valid if study is None else study, key, valid, ())


def checked_quantity(value: Any, kind: Any, hint: bool = True) -> float:
    """Return a value of this type as a plain number.

    ValueError says what would be right and, with a `hint`, what may have been meant.
    """
    try:
        return _adapter(kind).validate_python(value, strict=True)
    except ValidationError:
        raise ValueError(_wrong(value, _key(kind)) if hint else _key(kind).right()) from None


def is_number(value: Any) -> bool:
    """Return whether `value` is a finite number; True and False are none in a config, unlike in Python."""
    is_one = isinstance(value, int | float) and not isinstance(value, bool)
    return is_one and abs(value) <= sys.float_info.max  # a whole number may be above


_key, _adapter = cache(key_of), cache(TypeAdapter)


def _in_yaml(value: Any) -> str:
    is_word = value is None or isinstance(value, bool)
    return json.dumps(value) if is_word else format_value(value)


def _line(mistake: Mapping[str, Any], whole: Key, values: Any) -> str:
    """Write a mistake that pydantic found as ours."""
    parts, group, key, value = _place(mistake["loc"], whole, values)
    within = mistake.get("ctx", {}).get("within")
    if within is not None:  # of our own validators, which see a list or a group as a whole
        parts, value = [*parts, within], value[within]
    path, kind = key_path(parts), mistake["type"]
    setting = f"{path} = {_in_yaml(value)}"
    if kind == "missing":
        return f"{path}: missing, {key.right()}"
    if kind == "extra_forbidden" and path == "extend":
        return f"{setting}: is a key no more, give --configfile both files, the one named here first"
    if kind == "extra_forbidden":
        names = group.fields()
        close = [key_path([*parts[:-1], name]) for name in get_close_matches(str(parts[-1]), names, n=1)]
        hint = f"did you mean {close[0]}?" if close else f"known here: {', '.join(names)}"
        return f"{setting}: unknown key, {hint}"
    if kind in OWN:
        return f"{setting}: {mistake['msg']}"
    if mistake["loc"][-1:] == ("[key]",):
        return f"{path}: {key.right()}"
    return f"{setting}: {_wrong(value, key)}"


def _place(location: tuple, key: Key, value: Any) -> tuple[list[Any], Key, Key, Any]:
    """Follow the location of a mistake to its path, the group that it is in, its key and the value."""
    parts: list[Any] = []
    group = key
    for part in location:
        if part == "[key]":  # a name is wrong
            return parts, group, group.names, value
        if len(key.models) > 1:  # the part is the tag of a kind of group
            key = replace(key, models={"": key.models[part]})
            continue
        parts.append(part)
        group, key = key, key.inner(part)
        value = value[part] if isinstance(part, int) else value.get(part)
    return parts, group, key, value


def _wrong(value: Any, key: Key) -> str:
    """Say what is wrong with a value: another kind of quantity, another unit than is meant, or its size."""
    if key.kind not in NUMBERS:
        is_one = is_number(value) or isinstance(value, str)
        is_single = key.kind == "a list" and not key.entry.models and is_one
        return key.right() + (f"; write [{_in_yaml(value)}]" if is_single and key.sizes[0] < 2 else "")
    if is_number(value):
        return key.right() + key.meant(value)
    if isinstance(value, str) and (reading := yaml_reading(value)):
        return f"{key.right()} (YAML reads this as {reading})"
    if isinstance(value, str) and (decimal := decimal_form(value)):
        return f"{key.right()}; write {decimal}"
    if quantity := units.read(value):
        try:
            key.convert(quantity, lambda name: 1.0)
        except ValueError as error:
            return str(error)
        reference = key.unit.reference
        return (
            f"needs {reference} {NOT_KNOWN}; {key.right()}" if reference else f"{key.right()}, unit left out"
        )
    return key.right() + (units.comma(value) if isinstance(value, str) else "")


def _compared(config: Mapping[str, Any], key: Key, value: Any, parts: tuple) -> Iterator[str]:
    """Compare numbers and names in `value` with what other keys of the config say."""
    differences = []
    if key.one_of:
        names = config.get(key.one_of, {value})
        if value not in names:
            differences.append(f"one of the {key.one_of}, {', '.join(names)}")
    for limit in key.limits:
        bound: Any = config
        for part in limit.key.split("."):
            bound = bound.get(part, {})
        if is_number(bound) and not _RELATIONS[limit.relation](value, bound / limit.divisor):
            reason = f", {limit.reason}" if limit.reason else ""
            differences.append(f"{limit} = {bound / limit.divisor:g}{reason}")
    for difference in differences:
        yield f"{key_path(parts)} = {_in_yaml(value)}: must be {difference}"
    entries: Iterable[tuple[Any, Any]] = ()
    if isinstance(value, Mapping):
        entries = value.items()
    elif isinstance(value, list):
        entries = enumerate(value)
    for part, entry in entries:
        if inner := key.inner(part):
            yield from _compared(config, inner, entry, (*parts, part))
