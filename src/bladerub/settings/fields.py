"""What the models of a config are written with: sections, units, and bounds that other keys give.

A section is a pydantic model. Each of its keys has a type with a unit, bounds, and a docstring that says what
it is and why it has its value in the study of the paper::

    class Speeds(Section):
        '''Rotational frequencies that every coating is run at.'''

        step: Speed = Field(ge=1e-4, le=2)
        '''Determines how finely a peak is resolved; the cost is proportional to its inverse.'''

Plain numbers are SI, or in a size of the study: ``f1`` is the first frequency of the blade at rest,
``modulus_unit`` is ``contact.modulus_unit`` times ``contact.scale.modulus``. A number may also be typed with
a unit of the same kind (`bladerub.settings.units`).
"""

from collections.abc import Hashable, Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, ClassVar, Self, TypeVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field, GetCoreSchemaHandler
from pydantic_core import CoreSchema, PydanticCustomError

from bladerub.settings.units import Unit

T = TypeVar("T")


class Section(BaseModel):
    """A group of keys; its docstring says what it is of."""

    model_config: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", strict=True, frozen=True, allow_inf_nan=False, use_attribute_docstrings=True
    )

    def plugged(self, key: str, default: Any = None) -> Any:
        """Return what a key that plugs in has, and `default` without the plug-in or the key."""
        value = getattr(self, key, None)
        return default if value is None else value

    def plain(self) -> dict[str, Any]:
        """Return the values that are given, by their keys."""
        return self.model_dump(exclude_unset=True)

    def replaced(self, path: str, value: Any) -> Self:
        """Return a copy with another value, not checked, at a path such as ``solver.revolutions``."""
        key, _, below = path.partition(".")
        new = getattr(self, key).replaced(below, value) if below else value
        return self.model_copy(update={key: new})

    @classmethod
    def further_keys(cls, values: Mapping[str, Any]) -> Mapping[str, Any]:
        """Describe keys, as `bladerub.config.keys.Key`, that a group of these values has besides."""
        return {}


@dataclass(frozen=True)
class Limit:
    """A bound of a number that another key of the config gives, over a whole number; and the reason."""

    relation: str  # "at most", "below", "at least" or "above"
    key: str
    reason: str = ""
    divisor: int = 1

    def __str__(self) -> str:
        return f"{self.relation} {self.key}" + (f" / {self.divisor}" if self.divisor > 1 else "")


@dataclass(frozen=True)
class OneOf:
    """A text that is one of the keys of a group at the top of the config."""

    group: str


@dataclass(frozen=True)
class Form:
    """What a text must be, in words."""

    form: str


class _Omittable:
    """A key that may be left out; it may not be null."""

    def __get_pydantic_core_schema__(self, source: Any, handler: GetCoreSchemaHandler) -> CoreSchema:
        """Drop null of the type."""
        return handler(source)["schema"]


Omitted = Annotated[T | None, _Omittable()]
"""Type of a key that a config may lack: ``length: Omitted[Metre] = Field(None, ge=0)``."""


OWN = ("unique", "ascending", "kind", "disagree")
"""Types of the errors that validators here and in models raise: their messages say what is right."""


def disagreement(key: str, right: str) -> PydanticCustomError:
    """Make the error of a group whose keys do not agree: of one of them, and what would be right."""
    return PydanticCustomError("disagree", right.replace("{", "{{"), {"within": key})


def _unique(values: list[Hashable]) -> list[Hashable]:
    if len(set(values)) < len(values):
        raise PydanticCustomError("unique", "must not name one twice")
    return values


def _ascending(values: list[float]) -> list[float]:
    for index, (lower, upper) in enumerate(pairwise(values), 1):
        if float(f"{upper:g}") <= float(f"{lower:g}"):  # six digits, as in the names of files
            text = f"must be above the one before ({lower:g})"
            raise PydanticCustomError("ascending", text, {"within": index})
    return values


UNIQUE = AfterValidator(_unique)
"""A list that names nothing twice."""
ASCENDING = AfterValidator(_ascending)
"""A list each of whose numbers is above the one before."""

Number = Annotated[float, Unit("1")]
Metre = Annotated[float, Unit("m")]
ScaledMetre = Annotated[float, Unit("m", scaled="length")]
Pascal = Annotated[float, Unit("Pa")]
Degree = Annotated[float, Unit("degrees")]
Radian = Annotated[float, Unit("rad")]
Speed = Annotated[float, Unit("f1")]
Modulus = Annotated[float, Unit("modulus_unit")]
BladeLengths = Annotated[float, Unit("blade lengths")]
Seed = Annotated[int, Field(ge=0, le=4294967295)]
Name = Annotated[
    str,
    Field(pattern=r"^[A-Za-z][A-Za-z0-9_]*$", max_length=40),
    Form("at most 40 letters, digits and underscores, a letter first"),
]
"""A name that becomes that of a column or of a folder."""
