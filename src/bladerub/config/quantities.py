"""Quantities typed with a unit become the numbers that they stand for, wherever a config has a number."""

import re
from collections import ChainMap
from collections.abc import Callable, Iterator
from functools import cache, reduce
from typing import Any

from bladerub.blade.cache import first_frequency
from bladerub.config.errors import top_key
from bladerub.config.files import Located
from bladerub.config.keys import Key, key_of
from bladerub.config.problems import checked_quantity, problems
from bladerub.settings import units
from bladerub.settings.coatings import QUANTITIES
from bladerub.settings.study import Config, typed, whole
from bladerub.study.grid import SPEED_DECIMALS, UNSCALED, modulus_unit

_LIMIT = re.compile(
    rf"(?: =| from| to| above| below| at least| at most) ({units.NUMBER})(?!,\d)(?: (?:m|s)\b)?"
    rf"|, ({units.NUMBER}) (?:m|s)\b"
)
"""A number in the unit of the plain number, in what a problem says is right."""
_READS = {"f1": {"blade", "reduction"}, "modulus_unit": {"contact"}, "blade lengths": {"blade"}}
"""Keys at the top of the config that say what a reference is; `UNSCALED` ones are of ``contact``."""


class Unknown(ValueError):
    """The config does not say what a reference is, for problems of its own, which are perhaps named."""


def references(config: Config) -> units.Reference:
    """Return the sizes of a study for `Key.convert`; that of f1 raises ValueError or OSError for no blade."""

    def size(name: str) -> float:
        if name == "f1":
            return first_frequency(config)
        if name == "modulus_unit":
            return modulus_unit(config)
        if name == "blade lengths":
            return config.blade.length
        return getattr(config.contact.plugged("scale", UNSCALED), name)

    return size


def number(name: str, value: Any, reference: units.Reference) -> Any:
    """Return `value` as a plain number if it is a quantity with a unit, anything else as it is.

    `name` is one of `QUANTITIES`, such as ``E``, or the path of a key, such as ``rotor.length_scatter``. A
    speed is rounded as those of the grid. ValueError if the unit is of another kind, and as `reference`.
    """
    quantity = units.read(value)
    if quantity is None:
        return value
    key = key_of(QUANTITIES[name]) if name in QUANTITIES else key_at(name)
    plain = key.convert(quantity, reference)
    return round(plain, SPEED_DECIMALS) if name == "f_omega" else plain


def checked_number(name: str, value: Any, kind: Any, reference: units.Reference) -> float:
    """Return `value` as `number`, within the bounds of `kind`; ValueError states them in the unit typed."""
    plain = None
    try:
        plain = number(name, value, reference)
        return checked_quantity(plain, kind, hint=plain is value)
    except ValueError as error:
        raise ValueError(in_typed_unit(str(error), value, plain)) from None


def key_at(path: str) -> Key:
    """Return what a config may hold at a path such as ``rotor.blades``."""
    return reduce(Key.inner, path.split("."), key_of(whole()))


def converted(config: Located, kind: Any = None, study: Config | None = None) -> tuple[Located, list[str]]:
    """Return a config with plain numbers instead of quantities, and why a reference is not known, if so.

    A quantity of another kind than it must be, or of a reference that is not known, stays as it is: its model
    refuses it. A config has its own references; a plan, of the model `kind`, those of its checked `study`.
    """
    reasons: list[str] = []

    @cache
    def size(name: str) -> float | None:
        try:
            return references(study or _sound(config, _READS.get(name, {"contact"})))(name)
        except Unknown as error:
            reasons.extend(error.args)
            return None
        except (ValueError, OSError) as error:
            reasons.append(f"blade: no first frequency, which speeds in rpm need: {error}")
            return None

    def known(name: str) -> float:
        if (value := size(name)) is None:
            raise Unknown
        return value

    reference = unknown if kind and study is None else known
    return _converted(config, key_of(kind or whole()), reference), reasons


def as_typed(typed: Located, config: Located) -> Callable[[str], str]:
    """Return what adds to the text of a problem the quantity that was typed, where `config` has a number."""
    after = {path: entry.content for path, entry in config.walk()}
    before = ((path, entry.content) for path, entry in typed.walk())
    quantities = {path: text for path, text in before if units.read(text) and after.get(path) != text}

    def add(problem: str) -> str:
        setting, colon, right = problem.partition(": ")
        path = setting.partition(" = ")[0]
        if path not in quantities:
            return problem
        right = right.partition("; this is ")[0]  # a unit was typed, it needs no hint
        right = in_typed_unit(right, quantities[path], after[path])
        return f"{setting} ({quantities[path]}){colon}{right}"

    return add


def in_typed_unit(right: str, value: Any, plain: Any) -> str:
    """Return what is `right` with its limits in the unit of the quantity `value`, which is `plain`."""
    quantity = units.read(value)
    if quantity is None or not isinstance(plain, float) or plain in (0, float(quantity.number)):
        return right

    def add_typed(limit: re.Match) -> str:
        typed = float(limit[1] or limit[2]) / plain * float(quantity.number)
        return f"{limit[0]} ({typed:,.6g} {quantity.unit})"

    return _LIMIT.sub(add_typed, right)


def mixed(config: Located) -> Iterator[str]:
    """Yield a line for each list with quantities and plain numbers but 0, as of a decimal comma."""
    for path, entry in config.walk():
        values = [item.content for item in entry.content] if isinstance(entry.content, list) else []
        if any(map(units.read, values)) and any(isinstance(value, int | float) and value for value in values):
            text = ", ".join(map(str, values))
            yield f"{path} = [{text}]: must be all with a unit, or none; a decimal has a point"


def _sound(config: Located, parts: set[str]) -> Config:
    """Make a config of `parts`, any value for quantities; raises `Unknown` if one has another problem."""
    from bladerub.config.checks import check  # takes half a second to import

    values = _converted(config, key_of(whole()), unknown, lambda key: key.ends[1]).plain()
    others = whole().model_fields.keys() - parts
    if parts - values.keys() or any(top_key(text) in parts for text in problems(values)):
        raise Unknown
    if disagreements := check(sound := typed(values, others), others):
        raise Unknown(*disagreements)
    return sound


def unknown(name: str) -> float:
    """Be a reference of which nothing is known."""
    raise Unknown


def _converted(
    entry: Located, key: Key | None, reference: units.Reference, instead: Callable[[Key], float] | None = None
) -> Located:
    """Convert all that is in `entry`, with `instead` of a quantity whose reference is unknown."""
    content = entry.content
    if key is None:
        return entry
    if isinstance(content, dict):
        further = ChainMap(*(model.further_keys(entry.plain()) for model in key.models.values()))
        keys = {name: further.get(name) or key.inner(name) for name in content}
        content = {name: _converted(v, keys[name], reference, instead) for name, v in content.items()}
    elif isinstance(content, list):
        content = [_converted(v, key.entry, reference, instead) for v in content]
    elif key.kind == "a number" and (quantity := units.read(content)):
        try:
            content = key.convert(quantity, reference)
        except Unknown:
            content = instead(key) if instead else content
        except ValueError:
            return entry
    return Located(content, entry.location)
