"""What a config may hold below each key, read from the models."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import annotated_types as at
from pydantic import Tag
from pydantic.fields import FieldInfo

from bladerub.settings import units
from bladerub.settings.fields import ASCENDING, UNIQUE, Form, Limit, OneOf, Section, Unit

_KINDS = {float: "a number", int: "a whole number", str: "text", bool: "true or false"}
NUMBERS = ("a number", "a whole number")
_FEWEST, _MOST_HZ = 10.0, 1000.0  # of a plain number that is a speed in rpm or Hz
_WORDS = {"gt": "above", "ge": "of at least", "lt": "below", "le": "at most"}


@dataclass(frozen=True)
class Key:
    """What is allowed below one key, or as an entry of a list."""

    kind: str  # "a number", "a whole number", "text", "true or false", "a list", "a group of keys"
    description: str = ""
    bounds: Mapping[str, float] = field(default_factory=dict)  # "gt", "ge", "lt" and "le"; of numbers
    sizes: tuple[int, int | None] = (0, None)  # fewest and most entries of a list or group
    unit: Unit = Unit("1")  # noqa: RUF009
    form: str = ""  # what a text must be
    pattern: str = ""
    choices: tuple[str, ...] = ()  # of a text
    limits: tuple[Limit, ...] = ()
    one_of: str = ""  # group at the top of the config that has it as a key
    is_ascending: bool = False
    is_unique: bool = False
    models: Mapping[str, type[Section]] = field(default_factory=dict)  # of a group: its kinds by their tags
    names: "Key | None" = None  # of a group of names: what they must be
    entry: "Key | None" = None  # of a list, or of a group of names

    @property
    def lowest(self) -> float | None:
        """Lower bound of a number."""
        return self.bounds.get("ge", self.bounds.get("gt"))

    @property
    def highest(self) -> float | None:
        """Upper bound of a number."""
        return self.bounds.get("le", self.bounds.get("lt"))

    def fields(self) -> dict[str, "Key"]:
        """Return the keys of a group, of all the kinds that it may be of; those of one name say the same."""
        return {
            name: key for model in reversed(self.models.values()) for name, key in _keys_of(model).items()
        }

    def inner(self, name: str | None) -> "Key | None":
        """Return what is allowed under a name, or as an entry (None); None if nothing is known of it."""
        if name is None or (self.entry is not None and not self.models):
            return self.entry
        return self.fields().get(name, self.entry)

    def allowed(self) -> str:
        """Say kind and range, ``a number from 0.01 to 3``."""
        fewest, most = self.sizes
        if self.form:
            return self.form
        if self.kind == "a list":
            number = f"{fewest}" if fewest == most else f"{fewest} to {most}"
            number = f"{fewest} or more" if most is None else number
            return f"a list of {number} entries{', ascending' if self.is_ascending else ''}"
        if self.names:
            return f"{self.kind} with {fewest} to {most} of them" if most else self.kind
        if self.bounds.keys() == {"ge", "le"}:
            return f"{self.kind} from {self.lowest:g} to {self.highest:g}"
        words = (f"{word} {self.bounds[name]:g}" for name, word in _WORDS.items() if name in self.bounds)
        return f"{self.kind} {' and '.join(words)}".rstrip()

    @property
    def typed_units(self) -> str:
        """Units that a quantity may have, apart from that of a plain number; empty for none."""
        if self.unit.kind is None:
            return "%" if self.is_share else ""
        return units.choices_by_kind()[self.unit.kind]

    @property
    def is_share(self) -> bool:
        """Whether a value may be typed in %: pure numbers, and those in sizes of the study."""
        return self.kind == "a number" and (self.unit.kind is None or self.unit.name == "blade lengths")

    def right(self) -> str:
        """Say what is right: ``must be a number from 0.01 to 3, in m``."""
        words = self.unit.words
        behind = f", {words}" if words.startswith("in ") else words and f" ({words}; or {self.typed_units})"
        return f"must be {self.allowed()}{behind}"

    def convert(self, quantity: units.Quantity, reference: units.Reference) -> float:
        """Return a quantity as a plain number, see `bladerub.settings.units.convert`.

        Raises ValueError that says what the quantity is and what it must be, and as the `reference`.
        """
        kind, wanted = units.size_of(quantity.unit)[0], self.unit.kind
        if kind is None or (kind != wanted and not (kind == "share" and self.is_share)):
            raise ValueError(f"{units.mistaken(quantity.unit, wanted)}; must be {self._quantity()}")
        return units.convert(quantity, self.unit, reference)

    def _quantity(self) -> str:
        """Say which units a quantity may have, ``a speed: rpm, Hz, rad/s, or a number times the ...``."""
        kind = self.unit.kind
        if self.unit.name == "SI":
            return f"{self.kind} in the unit of this parameter (docs/laws.md), or another of its kind"
        if kind is None:
            return f"{self.kind}{', or %' if self.is_share else ' without a unit'}"
        return f"{units.article(kind)} {kind}: {self.typed_units}, or {self.kind} {self.unit.words}"

    def meant(self, value: float) -> str:
        """Say what a plain number out of range is, and what was probably meant; empty if nothing."""
        unit, proposals = self.unit.name, []
        if self.unit.kind is None or not value:
            return ""
        if unit == "f1" and value >= max(_FEWEST, self.highest):
            proposals = [f'"{value:g} rpm"'] + [f'"{value:g} Hz"'] * (value < _MOST_HZ)
        elif unit == "modulus_unit" and value > self.highest:
            proposals = [f'"{value / 1e6:g} MPa"']
        elif not self.unit.reference or self.unit.scaled:
            size = units.size_of(unit)[1]
            proposals = [
                f'"{value:g} {usual}"'
                for usual in self.typed_units.split(", ")[:2]
                if self.lowest <= value * float(units.size_of(usual)[1] / size) <= self.highest
            ]
        words = self.unit.words.removeprefix("in ")
        return f"; this is {value:g} {words}; write {' or '.join(proposals)}" if proposals else ""


@cache
def _keys_of(model: type[Section]) -> dict[str, Key]:
    return {name: key_of(info) for name, info in model.model_fields.items()}


def key_of(kind: Any) -> Key:
    """Describe a type, or the field of a model."""
    annotation, marks, text = _parts(kind if isinstance(kind, FieldInfo) else FieldInfo.from_annotation(kind))
    common: dict[str, Any] = {
        "description": " ".join(text.split()),
        "sizes": (_last(marks, at.MinLen, "min_length", 0), _last(marks, at.MaxLen, "max_length", None)),
        "form": _last(marks, Form, "words", ""),
        "limits": tuple(mark for mark in marks if isinstance(mark, Limit)),
        "one_of": _last(marks, OneOf, "group", ""),
        "is_ascending": ASCENDING in marks,
        "is_unique": UNIQUE in marks,
    }
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Literal:
        words = " or ".join(filter(None, (", ".join(map(str, arguments[:-1])), str(arguments[-1]))))
        return Key("text", **common | {"form": common["form"] or words, "choices": arguments})
    if origin is list:
        return Key("a list", entry=key_of(arguments[0]), **common)
    if origin is dict:
        names, entry = map(key_of, arguments)
        return Key("a group of keys", names=names, entry=entry, **common)
    if models := dict(_models(annotation)):
        first = next(iter(models.values()))
        common["description"] = common["description"] or " ".join((first.__doc__ or "").split())
        return Key("a group of keys", models=models, entry=_extra(first), **common)
    limits = {name: getattr(mark, name) for mark in marks for name in _WORDS if hasattr(mark, name)}
    return Key(
        _KINDS.get(annotation, "a group of keys"),
        bounds=limits,
        unit=next((mark for mark in marks if isinstance(mark, Unit)), Unit("1")),
        pattern=next((mark.pattern for mark in marks if getattr(mark, "pattern", None)), ""),
        **common,
    )


def _parts(info: FieldInfo) -> tuple[Any, list[Any], str]:
    """Take a field apart: its type, without null, what is said of that, and the description."""
    annotation, marks, text = info.annotation, list(info.metadata), info.description or ""
    if get_origin(annotation) in (Union, UnionType) and NoneType in get_args(annotation):
        (kind,) = (part for part in get_args(annotation) if part is not NoneType)
        annotation, inner, description = _parts(FieldInfo.from_annotation(kind))
        return annotation, [*inner, *marks], text or description
    return annotation, marks, text


def _last(marks: list[Any], kind: type, name: str, default: Any) -> Any:
    return next((getattr(mark, name) for mark in reversed(marks) if isinstance(mark, kind)), default)


def _models(annotation: Any, tag: str = "") -> Iterator[tuple[str, type[Section]]]:
    """Yield the models that a type stands for, with their tags: itself, or those that it may be one of."""
    if isinstance(annotation, type) and issubclass(annotation, Section):
        yield tag, annotation
    elif get_origin(annotation) is Annotated:
        kind, *marks = get_args(annotation)
        yield from _models(kind, next((mark.tag for mark in marks if isinstance(mark, Tag)), tag))
    elif get_origin(annotation) in (Union, UnionType):
        for part in get_args(annotation):
            yield from _models(part)


def _extra(model: type[Section]) -> Key | None:
    """Describe what a group that takes any names holds below them."""
    if model.model_config.get("extra") != "allow":
        return None
    return key_of(get_args(model.__annotations__["__pydantic_extra__"])[1])
