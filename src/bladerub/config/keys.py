"""What a config may hold below each key, read from the models."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cache
from types import NoneType, UnionType
from typing import Any, Literal, Union, get_args, get_origin

from pydantic.fields import FieldInfo

from bladerub.settings import units
from bladerub.settings.fields import ASCENDING, UNIQUE, Limit, Section, Unit

_KINDS = {float: "a number", int: "a whole number", str: "text", bool: "true or false"}
NUMBERS = ("a number", "a whole number")
_FEWEST, _MOST_HZ = 10.0, 1000.0  # of a plain number that is a speed in rpm or Hz
_WORDS = {"gt": "above", "ge": "of at least", "lt": "below", "le": "at most"}
_DIGITS = 12  # of a value in units of a reference, which is itself known to fewer
_CONSTRAINTS = (*_WORDS, "min_length", "max_length", "pattern", "form", "group")  # attributes of the marks


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
    def ends(self) -> tuple[float | None, float | None]:
        """Lower and upper bound of a number."""
        return self.bounds.get("ge", self.bounds.get("gt")), self.bounds.get("le", self.bounds.get("lt"))

    def fields(self) -> dict[str, "Key"]:
        """Return the keys of a group, of all the kinds that it may be of; those of one name say the same."""
        return {
            name: key for model in reversed(self.models.values()) for name, key in _keys_of(model).items()
        }

    def inner(self, part: str | int) -> "Key | None":
        """Return what is allowed under a name, or as an entry of a list; None if nothing is known of it."""
        return self.fields().get(part, self.entry)

    def allowed(self) -> str:
        """Say kind and range, ``a number from 0.01 to 3``."""
        if self.form:
            return self.form
        fewest, most = self.sizes
        if self.kind == "a list":
            upper = " or more" if most is None else f" to {most}"
            number = f"{fewest}{'' if fewest == most else upper}"
            return f"a list of {number} entries{', ascending' if self.is_ascending else ''}"
        if self.names:
            return f"{self.kind} with {fewest} to {most} of them" if most else self.kind
        if self.bounds.keys() == {"ge", "le"}:
            return f"{self.kind} from {self.bounds['ge']:g} to {self.bounds['le']:g}"
        words = (f"{word} {self.bounds[name]:g}" for name, word in _WORDS.items() if name in self.bounds)
        return f"{self.kind} {' and '.join(words)}".rstrip()

    @property
    def typed_units(self) -> str:
        """Units that a quantity may have, apart from that of a plain number; empty for none."""
        return units.choices_by_kind().get(self.unit.kind, "%" if self.is_share else "")

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
        """Return a quantity as a plain number.

        It is the number nearest to the exact one, as if that were typed; in units of a `reference` it has
        twelve digits, and where ``contact.scale`` multiplies plain numbers, it is divided by that. Raises
        ValueError that says what the quantity is and what it must be, and as the `reference`.
        """
        kind, size = units.size_of(quantity.unit)
        if kind is None or (kind != self.unit.kind and not (kind == "share" and self.is_share)):
            raise ValueError(f"{units.mistaken(quantity.unit, self.unit.kind)}; must be {self._quantity()}")
        exact = quantity.number * size
        if kind == "share" or self.unit.reference is None:
            return float(exact / units.size_of(self.unit.name)[1])
        divisor = reference(self.unit.reference)
        if divisor == 1:  # as where no ``contact.scale`` is
            return float(exact)
        return float(f"{float(exact / Fraction(divisor)):.{_DIGITS}g}")

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
        unit, (low, high), proposals = self.unit.name, self.ends, []
        if self.unit.kind is None or not value:
            return ""
        if unit == "f1" and value >= max(_FEWEST, high):
            proposals = [f'"{value:g} rpm"'] + [f'"{value:g} Hz"'] * (value < _MOST_HZ)
        elif unit == "modulus_unit" and value > high:
            proposals = [f'"{value / 1e6:g} MPa"']
        elif not self.unit.reference or self.unit.scaled:
            size = units.size_of(unit)[1]
            proposals = [
                f'"{value:g} {usual}"'
                for usual in self.typed_units.split(", ")[:2]
                if low <= value * float(units.size_of(usual)[1] / size) <= high
            ]
        words = self.unit.words.removeprefix("in ")
        return f"; this is {value:g} {words}; write {' or '.join(proposals)}" if proposals else ""


@cache
def _keys_of(model: type[Section]) -> dict[str, Key]:
    return {name: key_of(info) for name, info in model.model_fields.items()}


def key_of(kind: Any) -> Key:
    """Describe a type, or the field of a model."""
    info = kind if isinstance(kind, FieldInfo) else FieldInfo.from_annotation(kind)
    annotation, marks, text = info.annotation, info.metadata, info.description
    while NoneType in get_args(annotation):  # it may be left out: its type says the rest
        (kind,) = (part for part in get_args(annotation) if part is not NoneType)
        info = FieldInfo.from_annotation(kind)
        annotation, marks, text = info.annotation, [*info.metadata, *marks], text or info.description
    constraints = {
        name: getattr(mark, name) for mark in marks for name in _CONSTRAINTS if hasattr(mark, name)
    }
    key = Key(
        "a group of keys",
        description=" ".join((text or "").split()),
        bounds={name: bound for name, bound in constraints.items() if name in _WORDS},
        sizes=(constraints.get("min_length", 0), constraints.get("max_length")),
        unit=next((mark for mark in marks if isinstance(mark, Unit)), Unit("1")),
        form=constraints.get("form", ""),
        pattern=constraints.get("pattern", ""),
        limits=tuple(mark for mark in marks if isinstance(mark, Limit)),
        one_of=constraints.get("group", ""),
        is_ascending=ASCENDING in marks,
        is_unique=UNIQUE in marks,
    )
    origin, arguments = get_origin(annotation), get_args(annotation)
    if origin is Literal:
        words = " or ".join(filter(None, (", ".join(map(str, arguments[:-1])), str(arguments[-1]))))
        return replace(key, kind="text", form=key.form or words, choices=arguments)
    if origin is list:
        return replace(key, kind="a list", entry=key_of(arguments[0]))
    if origin is dict:
        names, entry = map(key_of, arguments)
        return replace(key, names=names, entry=entry)
    if origin in (Union, UnionType):  # of kinds of a group
        models = {tag.tag: model for model, tag in map(get_args, arguments)}
    elif isinstance(annotation, type) and issubclass(annotation, Section):
        models = {"": annotation}
    else:
        return replace(key, kind=_KINDS.get(annotation, key.kind))
    first = next(iter(models.values()))
    extra = first.__annotations__.get("__pydantic_extra__")
    return replace(
        key,
        description=key.description or " ".join((first.__doc__ or "").split()),
        models=models,
        entry=key_of(get_args(extra)[1]) if extra else None,
    )
