"""The plan of a design: the factors that vary, and parts, which are small studies for some of the claims.

Each part has as many samples as its runs allow. All draw from one Sobol sequence: sample 7 has the same
factors in each.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Set
from dataclasses import dataclass
from pathlib import Path
from typing import NoReturn

import numpy as np
from scipy.stats import qmc

from bladerub.config.errors import UNKNOWN, ConfigError, Location, format_value
from bladerub.config.files import Located
from bladerub.config.files import read as read_file
from bladerub.config.schema import is_number

BATCH = 8
"""Samples of one job."""

REFERENCE, REFERENCE_BATCH = -1, "reference"
"""Number of the sample that has the study's own values, and name of its job."""

MOST_SAMPLES = 4096
"""Samples of one part."""

CLAIMS = tuple(f"C{number}" for number in range(1, 13))
"""Claims of the paper, without the letters of their parts."""

_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,39}")


@dataclass(frozen=True)
class Factor:
    """One choice that the paper leaves open.

    Parameters
    ----------
    name, unit : str
        Name in the plan, and the unit of its values.
    ends : dict of str to tuple of float
        Lowest and highest value of each number of the config that the factor sets.
    logarithmic : bool
        Whether the values lie evenly on a logarithmic scale.
    multiple_of : float or None
        Values are rounded to a multiple of it.
    location : Location
        Where the plan has it.
    """

    name: str
    unit: str
    ends: dict[str, tuple[float, float]]
    logarithmic: bool = False
    multiple_of: float | None = None
    location: Location = UNKNOWN

    def values(self, at: float) -> dict[str, float]:
        """Return each number that the factor sets, `at` between 0 and 1 of its range."""
        return {path: self._between(*ends, at) for path, ends in self.ends.items()}

    def _between(self, low: float, high: float, at: float) -> float:
        if self.logarithmic:
            value = math.exp(math.log(low) + at * math.log(high / low))
        else:
            value = low + at * (high - low)
        if self.multiple_of is None:
            return value
        rounded = round(round(value / self.multiple_of) * self.multiple_of, 9)
        return int(rounded) if float(self.multiple_of).is_integer() else rounded


@dataclass(frozen=True)
class Part:
    """A small study for some of the claims.

    Parameters
    ----------
    name : str
        Name in the plan.
    claims : tuple of str
        Claims that it is for, ``C2`` or ``C12``.
    samples : int
        So many of the sequence.
    study : Located
        What is laid over the study.
    """

    name: str
    claims: tuple[str, ...]
    samples: int
    study: Located

    def batches(self) -> list[range]:
        """Return the samples of each job; that of the reference is one more."""
        return [range(first, min(first + BATCH, self.samples)) for first in range(0, self.samples, BATCH)]


@dataclass(frozen=True)
class Plan:
    """A plan as read.

    Parameters
    ----------
    seed : int
        Of the scrambling of the sequence.
    factors : tuple of Factor
    parts : dict of str to Part
    """

    seed: int
    factors: tuple[Factor, ...]
    parts: dict[str, Part]

    def places(self) -> np.ndarray:
        """Return the samples (n, d) of the d factors, each from 0 to 1; n is that of the largest part."""
        sequence = qmc.Sobol(len(self.factors), scramble=True, rng=np.random.default_rng(self.seed))
        return sequence.random(max(part.samples for part in self.parts.values()))


def read_plan(path: str | Path) -> Plan:
    """Read a plan.

    Parameters
    ----------
    path : path-like
        YAML file with ``seed``, ``factors`` and ``parts`` (config/robustness.yaml says more).

    Raises
    ------
    ConfigError
        If it is no such plan; names file, line, key, value and what would be right.
    """
    groups = _group(read_file(path), "", {"seed", "factors", "parts"})
    seed = _whole(groups["seed"], "seed", 0, 2**32 - 1)
    factors = tuple(
        _factor(name, entry, f"factors.{name}") for name, entry in _named(groups["factors"], "factors")
    )
    set_before: set[str] = set()
    for factor in factors:
        if twice := set_before & factor.ends.keys():
            text = f"factors.{factor.name}.sets.{min(twice)}: is set by another factor, must be by one alone"
            raise ConfigError.at(factor.location, text)
        set_before |= factor.ends.keys()
    parts: dict[str, Part] = {}
    answered: set[str] = set()
    for name, entry in _named(groups["parts"], "parts"):
        parts[name] = part = _part(name, entry, f"parts.{name}")
        if answered & set(part.claims):
            _refuse(entry.content["claims"], f"parts.{name}.claims", "of claims that no other part has")
        answered |= set(part.claims)
    return Plan(seed, factors, parts)


def _factor(name: str, entry: Located, where: str) -> Factor:
    group = _group(entry, where, {"unit", "sets"}, {"scale", "multiple_of"})
    unit = _text(group["unit"], f"{where}.unit")
    scale = _text(group["scale"], f"{where}.scale") if "scale" in group else "linear"
    if scale not in ("linear", "log"):
        _refuse(group["scale"], f"{where}.scale", "linear or log")
    multiple = None
    if "multiple_of" in group:
        multiple = group["multiple_of"].plain()
        if not is_number(multiple) or multiple <= 0:
            _refuse(group["multiple_of"], f"{where}.multiple_of", "a number above 0")
    ends = {
        path: _ends(pair, f"{where}.sets.{path}", scale, multiple)
        for path, pair in _group(group["sets"], f"{where}.sets").items()
    }
    if not ends:
        _refuse(group["sets"], f"{where}.sets", "at least one number of the config, with its two ends")
    return Factor(name, unit, ends, logarithmic=scale == "log", multiple_of=multiple, location=entry.location)


def _ends(entry: Located, where: str, scale: str, multiple: float | None) -> tuple[float, float]:
    pair = entry.plain()
    if not isinstance(pair, list) or len(pair) != 2 or not all(map(is_number, pair)) or pair[0] >= pair[1]:
        _refuse(entry, where, "a list of two numbers, the lower first")
    if scale == "log" and pair[0] <= 0:
        _refuse(entry, where, "above 0 on a logarithmic scale")
    if multiple and any(abs(end / multiple - round(end / multiple)) > 1e-6 for end in pair):
        _refuse(entry, where, f"multiples of {multiple:g}, as all values between them are")
    return float(pair[0]), float(pair[1])


def _part(name: str, entry: Located, where: str) -> Part:
    group = _group(entry, where, {"claims", "samples", "study"})
    claims = group["claims"].plain()
    if not isinstance(claims, list) or not all(str(claim) in CLAIMS for claim in claims) or not claims:
        _refuse(group["claims"], f"{where}.claims", f"a list of claims, {CLAIMS[0]} to {CLAIMS[-1]}")
    samples = _whole(group["samples"], f"{where}.samples", 2, MOST_SAMPLES)
    if samples & (samples - 1):
        _refuse(group["samples"], f"{where}.samples", "a power of two, for the balance of Sobol's sequence")
    _group(group["study"], f"{where}.study")
    return Part(name, tuple(claims), samples, group["study"])


def _named(entry: Located, where: str) -> Iterator[tuple[str, Located]]:
    entries = _group(entry, where)
    if not entries:
        _refuse(entry, where, "a group of at least one")
    for name, value in entries.items():
        if not _NAME.fullmatch(name):
            _refuse(value, f"{where}.{name}", "named by letters and digits, a letter first")
        yield name, value


def _group(
    entry: Located, where: str, needed: Set[str] = frozenset(), optional: Set[str] | None = None
) -> dict[str, Located]:
    """Return the keys of a group; `needed` and `optional` are all it may have, if there are any needed."""
    if not isinstance(entry.content, dict):
        _refuse(entry, where, "a group of keys")
    dot = f"{where}." if where else ""
    for key in sorted(needed - entry.content.keys()):
        raise ConfigError.at(entry.location, f"{dot}{key}: missing")
    for key in entry.content.keys() - needed - (optional or set()) if needed else ():
        known = ", ".join(sorted(needed | (optional or set())))
        raise ConfigError.at(entry.content[key].location, f"{dot}{key}: unknown key, known here: {known}")
    return entry.content


def _text(entry: Located, where: str) -> str:
    if not isinstance(entry.content, str):
        _refuse(entry, where, "text")
    return entry.content


def _whole(entry: Located, where: str, least: int, most: int) -> int:
    value = entry.content
    if isinstance(value, bool) or not isinstance(value, int) or not least <= value <= most:
        _refuse(entry, where, f"a whole number from {least} to {most}")
    return value


def _refuse(entry: Located, where: str, right: str) -> NoReturn:
    raise ConfigError.at(entry.location, f"{where} = {format_value(entry.plain())}: must be {right}")
