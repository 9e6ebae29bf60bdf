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
from typing import Any, NamedTuple

from bladerub.io.errors import format_value

_PI = Fraction(math.pi)
_MILLE, _MICRO = Fraction(1, 1000), Fraction(1, 1_000_000)
UNITS: dict[str, dict[str, Fraction | int]] = {
    "length": {"mm": _MILLE, "µm": _MICRO, "um": _MICRO, "μm": _MICRO, "cm": Fraction(1, 100), "m": 1}
    | dict.fromkeys(("in", "inch"), Fraction(254, 10_000))
    | dict.fromkeys(("ft", "feet"), Fraction(3048, 10_000)),
    "pressure": {"MPa": 10**6, "GPa": 10**9, "kPa": 1000, "Pa": 1, "N/mm2": 10**6, "N/mm²": 10**6}
    | {"bar": 10**5, "psi": Fraction("6894.757293168")},
    "speed": dict.fromkeys(("rpm", "RPM", "1/min", "rev/min", "U/min", "min-1"), Fraction(1, 60))
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
"""Units by the kind of quantity, with their size in SI."""
_OF_NO_KEY: dict[str, dict[str, Fraction | int]] = {  # to say what they are
    "energy": {"J": 1, "mJ": _MILLE},
    "mass": {"kg": 1, "g": _MILLE},
    "force": {"N": 1, "kN": 1000},
}
_UNITS = {
    unit: (kind, Fraction(size))
    for kind, units in (UNITS | _OF_NO_KEY).items()
    for unit, size in units.items()
}

_REFERENCES = {"f1": "speed", "f1/s": "rate of speed", "modulus_unit": "pressure", "blade lengths": "length"}
_IN_WORDS = {
    "f1": "times the first frequency at rest",
    "f1/s": "times the first frequency at rest, in a second",
    "modulus_unit": "times contact.modulus_unit",
}
NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d{1,2})?"
_QUANTITY = re.compile(rf"\s*({NUMBER})\s*(1/min|[^\s\d.,+-].*?)\s*", re.S)

Reference = Callable[[str], float]
"""Gives what ``f1`` (Hz), ``modulus_unit`` (Pa) or ``blade lengths`` (m) is, or a factor of contact.scale."""


@dataclass(frozen=True)
class Unit:
    """Unit of a plain number; one may also be typed with a unit of its own.

    `scaled` names the factor of ``contact.scale`` by which plain numbers are multiplied, and quantities with
    a unit are not.
    """

    name: str
    scaled: str | None = None

    @property
    def kind(self) -> str | None:
        """Kind of quantity that it is a unit of; None of pure numbers, and of those in what is no unit."""
        return _REFERENCES.get(self.name) or _UNITS.get(self.name, (None,))[0]

    @property
    def reference(self) -> str | None:
        """Name of the reference that a quantity is divided by; None for none."""
        return {"f1/s": "f1"}.get(self.name, self.name) if self.name in _REFERENCES else self.scaled

    @property
    def words(self) -> str:
        """What a plain number is in, ``in m``; empty of a pure one."""
        return "" if self.name == "1" else _IN_WORDS.get(self.name, f"in {self.name}")


class Quantity(NamedTuple):
    """A number and its unit as typed; the unit need not be a known one."""

    number: Fraction
    unit: str


def read(text: Any) -> Quantity | None:
    """Read a number with a unit; None of anything else, plain numbers included."""
    match = _QUANTITY.fullmatch(text) if isinstance(text, str) and len(text) < 60 else None
    return Quantity(Fraction(match[1]), " ".join(match[2].split())) if match else None


def size_of(unit: str) -> tuple[str | None, Fraction]:
    """Return the kind of a unit and its size in SI; kind None of one that is not known."""
    return _UNITS.get(unit, (None, Fraction(1)))


@cache
def choices_by_kind() -> dict[str, str]:
    """List the units of each kind of quantity, one of each size."""
    lists = {}
    for kind, units in UNITS.items():
        first = {size: unit for unit, size in reversed(units.items())}
        lists[kind] = ", ".join(unit for unit, size in units.items() if first[size] == unit)
    return lists


def speed_in_words(f_omega: float, f1_hz: float | None) -> str:
    """Write a normalised speed, and in rpm where the first frequency at rest is known."""
    rpm = f", {60 * f_omega * f1_hz:,.6g} rpm" if f1_hz else ""
    return f"{f_omega:g} of the first frequency at rest{rpm}"


def speeds_in_words(speeds: Sequence[float], f1_hz: float | None) -> str:
    """Write number and ends of ascending normalised speeds, as `speed_in_words`."""
    low, high = speeds[0], speeds[-1]
    rpm = f", {60 * low * f1_hz:,.0f} to {60 * high * f1_hz:,.0f} rpm" if f1_hz else ""
    return f"{len(speeds)}, from {low:g} to {high:g} of the first frequency at rest{rpm}"


def pressure_in_words(pascal: float) -> str:
    """Write a pressure in MPa or GPa."""
    return f"{pascal / 1e9:.4g} GPa" if pascal >= 1e9 else f"{pascal / 1e6:.4g} MPa"


def doubted_modulus(pascal: float) -> str:
    """Doubt an E as of a metal, in MPa perhaps where it is in ``contact.modulus_unit``; empty of others."""
    remedy = 'a plain number is times contact.modulus_unit, "1200 MPa" is not'
    return f"{pressure_in_words(pascal)}, more than coatings have; {remedy}" if pascal > 100e9 else ""


def moduli_in_words(pascal: Sequence[float]) -> str:
    """Write the range of Young moduli, to stand behind something else; empty of none."""
    return f", E from {pressure_in_words(min(pascal))} to {pressure_in_words(max(pascal))}" if pascal else ""


def mistaken(unit: str, kind: str | None) -> str:
    """Say what a quantity is by its unit, where one of another kind, or a known unit of it, was meant."""
    actual, _ = size_of(unit)
    if actual:
        return f"is {article(actual)} {actual}"
    lower = {known.lower(): known for known in reversed(UNITS.get(kind, {}))}
    close = get_close_matches(unit.lower(), lower, n=1)
    hint = f", did you mean {lower[close[0]]}?" if close else ""
    return f"has the unknown unit {format_value(unit)}{hint}"


def comma(text: str) -> str:
    """Say what to write instead where digits are separated; empty where they are not."""
    return "; a decimal has a point, thousands have nothing" if re.search(r"\d[, ]\d", text) else ""


def article(kind: str) -> str:
    """Return ``a`` or ``an``."""
    return "an" if kind[0] in "aeiou" else "a"
