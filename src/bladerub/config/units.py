"""Units that a quantity may be typed with, ``2000 rpm``, and its value in the unit of its key.

The models say the unit of every key. Most are SI; ``f1``, ``f1/s``, ``modulus_unit`` and ``blade lengths``
are sizes of the study itself, its *references*: what one of them is in SI is known once the study is.
"""

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from fractions import Fraction
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from bladerub.config.errors import format_value

if TYPE_CHECKING:
    from pydantic import GetJsonSchemaHandler
    from pydantic_core import CoreSchema

_PI = Fraction(math.pi)
_MILLE, _MICRO = Fraction(1, 1000), Fraction(1, 1_000_000)
_TABLE: dict[str, dict[str, Fraction | int]] = {
    "length": {"mm": _MILLE, "µm": _MICRO, "um": _MICRO, "μm": _MICRO, "cm": Fraction(1, 100), "m": 1}
    | dict.fromkeys(("in", "inch"), Fraction(254, 10_000))
    | dict.fromkeys(("ft", "feet"), Fraction(3048, 10_000)),
    "pressure": {"MPa": 10**6, "GPa": 10**9, "kPa": 1000, "Pa": 1, "N/mm2": 10**6, "N/mm²": 10**6}
    | {"bar": 10**5, "psi": Fraction("6894.757293168")},
    "speed": dict.fromkeys(("rpm", "RPM", "1/min", "rev/min"), Fraction(1, 60))
    | {"Hz": 1, "rad/s": 1 / (2 * _PI)},
    "rate of speed": {"rpm/s": Fraction(1, 60), "Hz/s": 1},
    "time": {"µs": _MICRO, "us": _MICRO, "μs": _MICRO, "ms": _MILLE, "s": 1, "min": 60},
    "angle": {"deg": _PI / 180, "rad": 1, "°": _PI / 180, "degrees": _PI / 180},
    "density": {"kg/m3": 1, "kg/m³": 1, "g/cm3": 1000, "g/cm³": 1000},
    "velocity": {"m/s": 1, "mm/s": _MILLE, "km/h": Fraction(10, 36)},
    "rise of temperature": {"K": 1, "degC": 1, "°C": 1},
    "viscosity": {"Pa s": 1, "kPa s": 1000, "MPa s": 10**6},
    "heat capacity": {"J/(m3 K)": 1, "J/(m³ K)": 1, "kJ/(m3 K)": 1000, "MJ/(m3 K)": 10**6},
    "conductivity": {"W/(m K)": 1},
    "share": {"%": Fraction(1, 100)},
}
_OF_NO_KEY: dict[str, dict[str, Fraction | int]] = {  # to say what they are
    "energy": {"J": 1, "mJ": _MILLE},
    "mass": {"kg": 1, "g": _MILLE},
    "force": {"N": 1, "kN": 1000},
}
_UNITS = {
    unit: (kind, Fraction(size))
    for kind, units in (_TABLE | _OF_NO_KEY).items()
    for unit, size in units.items()
}

_REFERENCES = {"f1": "speed", "f1/s": "rate of speed", "modulus_unit": "pressure", "blade lengths": "length"}
_IN_WORDS = {
    "f1": "times the first frequency at rest",
    "f1/s": "times the first frequency at rest, in a second",
    "modulus_unit": "times contact.modulus_unit",
}
_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_QUANTITY = re.compile(rf"\s*({_NUMBER})\s*([^\s\d.,+-].*?)\s*", re.S)
_FEWEST, _MOST_HZ = 10.0, 1000.0  # of a plain number that is a speed in rpm or Hz
_DIGITS = 12  # of a value in units of a reference, which is itself known to fewer

Reference = Callable[[str], float]
"""Gives what ``f1`` (Hz), ``modulus_unit`` (Pa) or ``blade lengths`` (m) is, or a factor of contact.scale."""


@dataclass(frozen=True)
class Unit:
    """Unit of a plain number; one may also be typed with a unit of its own.

    `scaled` names the factor of ``contact.scale`` by which plain numbers are multiplied, and quantities with
    a unit are not. A quantity is rounded up to so many `decimals`.
    """

    name: str
    scaled: str | None = None
    decimals: int | None = None

    def __get_pydantic_json_schema__(
        self, core: "CoreSchema", handler: "GetJsonSchemaHandler"
    ) -> dict[str, Any]:
        """Allow text that is a number with a unit."""
        return {"anyOf": [handler(core), {"type": "string", "pattern": pattern(self.name)}]}


class NumberKey(Protocol):
    """A number of a config (`bladerub.config.keys.Key`): its kind in words, its unit and its bounds."""

    @property
    def kind(self) -> str:
        """Say ``a number`` or ``a whole number``."""

    @property
    def unit(self) -> Unit:
        """Return that of a plain number."""

    @property
    def lowest(self) -> float | None:
        """Return its lower bound."""

    @property
    def highest(self) -> float | None:
        """Return its upper bound."""


class Quantity(NamedTuple):
    """A number and its unit as typed; the unit need not be a known one."""

    number: Fraction
    unit: str


def read(text: Any) -> Quantity | None:
    """Read a number with a unit; None of anything else, plain numbers included."""
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) and len(text) < 60 else None
    return Quantity(Fraction(match[1]), " ".join(match[2].split())) if match else None


def needs(key: NumberKey) -> str | None:
    """Return the reference that a quantity below this key is divided by; None for none."""
    unit = key.unit.name
    return {"f1/s": "f1"}.get(unit, unit) if unit in _REFERENCES else key.unit.scaled


def convert(quantity: Quantity, key: NumberKey, reference: Reference) -> float:
    """Return the value of a quantity in the unit of its key.

    It is the number nearest to the exact one, as if that were typed; in units of a reference it has twelve
    digits. ``decimals`` of the unit round it up, ``scaled`` undoes what multiplies it later. Raises
    ValueError that says what the quantity is and what it must be, and as the `reference`.
    """
    kind, size = _UNITS.get(quantity.unit, (None, Fraction(1)))
    if kind is None or (kind != _kind(key) and not (kind == "share" and _is_share(key))):
        raise ValueError(f"{_what_is(quantity.unit, kind, _kind(key))}; must be {right(key)}")
    exact, relative_to = quantity.number * size, needs(key)
    if kind == "share" or relative_to is None:
        return float(exact / _UNITS.get(key.unit.name, ("", 1))[1])
    divisor = reference(relative_to)
    if divisor == 1:  # as where no ``contact.scale`` is
        return float(exact)
    value = float(f"{float(exact / Fraction(divisor)):.{_DIGITS}g}")
    if (decimals := key.unit.decimals) is not None:
        value = math.ceil(round(value * 10**decimals, 3)) / 10**decimals
    return value


def right(key: NumberKey) -> str:
    """Say which units a quantity may have: ``a speed: rpm, Hz, rad/s, or a number times the first ...``."""
    kind, unit = _kind(key), key.unit.name
    if unit == "SI":
        return f"{key.kind} in the unit of this parameter (docs/laws.md), or another of its kind"
    if kind is None:
        return f"{key.kind}{', or %' if _is_share(key) else ' without a unit'}"
    return f"{_article(kind)} {kind}: {choices(key)}, or {key.kind} {_IN_WORDS.get(unit, f'in {unit}')}"


def pattern(unit: str) -> str:
    """Return what matches a number typed with a unit, where this is the unit of a plain one."""
    kind = _REFERENCES.get(unit) or _UNITS.get(unit, (None,))[0]
    kinds = _TABLE if unit == "SI" else [kind] if kind else ["share"]
    kinds = [*kinds, "share"] if unit == "blade lengths" else kinds
    names = [name for kind in kinds for name in _TABLE[kind]]
    return rf"^\s*{_NUMBER}\s*({'|'.join(map(re.escape, names))})\s*$"


@cache
def choices_by_kind() -> dict[str, str]:
    """List the units of each kind of quantity, one of each size."""
    lists = {}
    for kind, units in _TABLE.items():
        first = {size: unit for unit, size in reversed(units.items())}
        lists[kind] = ", ".join(unit for unit, size in units.items() if first[size] == unit)
    return lists


def choices(key: NumberKey) -> str:
    """List the units that a quantity below this key may have; empty for none."""
    kind = _kind(key)
    if kind is None:
        return "%" if _is_share(key) else ""
    return choices_by_kind()[kind]


def in_words(key: NumberKey) -> str:
    """Say what a plain number below this key is in, to stand behind it; empty for a pure one."""
    unit = key.unit.name
    if unit == "1":
        return ""
    return f" ({_IN_WORDS[unit]}; or {choices(key)})" if unit in _IN_WORDS else f", in {unit}"


def meant(value: float, key: NumberKey) -> str | None:
    """Say what a plain number outside of its range is, and what was probably meant; None if nothing is."""
    kind, unit = _kind(key), key.unit.name
    if kind is None or not value:
        return None
    words, proposals = _IN_WORDS.get(unit, unit), []
    if unit == "f1" and value >= max(_FEWEST, key.highest):
        proposals = [f'"{value:g} rpm"'] + [f'"{value:g} Hz"'] * (value < _MOST_HZ)
    elif unit == "modulus_unit" and value > key.highest:
        proposals = [f'"{value / 1e6:g} MPa"']
    elif unit not in _REFERENCES:
        proposals = _in_range(value, key)
    return f"is {value:g} {words}; write {' or '.join(proposals)}" if proposals else None


def _in_range(value: float, key: NumberKey) -> list[str]:
    return [
        f'"{value:g} {unit}"'
        for unit in choices(key).split(", ")[:2]  # the usual ones
        if key.lowest <= value * float(_UNITS[unit][1] / _UNITS[key.unit.name][1]) <= key.highest
    ]


def speed_in_words(f_omega: float, f1_hz: float | None) -> str:
    """Write a normalised speed, and in rpm where the first frequency at rest is known."""
    rpm = f", {60 * f_omega * f1_hz:,.0f} rpm" if f1_hz else ""
    return f"{f_omega:g} of the first frequency at rest{rpm}"


def speeds_in_words(speeds: Sequence[float], f1_hz: float | None) -> str:
    """Write number and ends of ascending normalised speeds, as `speed_in_words`."""
    low, high = speeds[0], speeds[-1]
    rpm = f", {60 * low * f1_hz:,.0f} to {60 * high * f1_hz:,.0f} rpm" if f1_hz else ""
    return f"{len(speeds)}, from {low:g} to {high:g} of the first frequency at rest{rpm}"


def pressure_in_words(pascal: float) -> str:
    """Write a pressure in MPa or GPa."""
    return f"{pascal / 1e9:.4g} GPa" if pascal >= 1e9 else f"{pascal / 1e6:.4g} MPa"


def _kind(key: NumberKey) -> str | None:
    """Say which kind of quantity a number below this key is; None of a pure number."""
    unit = key.unit.name
    return _REFERENCES.get(unit) or _UNITS.get(unit, (None,))[0]


def _is_share(key: NumberKey) -> bool:
    """Return whether a value may be typed in %: pure numbers, and those in sizes of the study."""
    return key.kind == "a number" and (_kind(key) is None or key.unit.name == "blade lengths")


def _what_is(unit: str, kind: str | None, wanted: str | None) -> str:
    if kind is not None:
        return f"is {_article(kind)} {kind}"
    lower = {known.lower(): known for known in reversed(_TABLE.get(wanted, _UNITS))}
    close = get_close_matches(unit.lower(), lower, n=1)
    hint = f", did you mean {lower[close[0]]}?" if close else ""
    return f"has the unknown unit {format_value(unit)}{hint}"


def _article(kind: str) -> str:
    return "an" if kind[0] in "aeiou" else "a"
