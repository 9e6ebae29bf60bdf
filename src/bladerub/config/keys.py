"""What a config may hold below each key, read from the models."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Literal, Union, get_args, get_origin

import annotated_types as at
from pydantic import Tag
from pydantic.fields import FieldInfo

from bladerub.config import units
from bladerub.config.fields import ASCENDING, Form, Limit, OneOf, Section, Unit

_KINDS = {float: "a number", int: "a whole number", str: "text", bool: "true or false"}
NUMBERS = ("a number", "a whole number")
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
    limits: tuple[Limit, ...] = ()
    one_of: str = ""  # group at the top of the config that has it as a key
    is_ascending: bool = False
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

    def right(self) -> str:
        """Say what is right: ``must be a number from 0.01 to 3, in m``."""
        return f"must be {self.allowed()}{units.in_words(self)}"


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
    }
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Literal:
        words = " or ".join(filter(None, (", ".join(map(str, arguments[:-1])), str(arguments[-1]))))
        return Key("text", **common | {"form": common["form"] or words})
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
