"""What varies in a design: factors, each of which sets one or more numbers of the config."""

import copy
import itertools
import math
import re
from collections.abc import Iterable
from dataclasses import dataclass
from functools import reduce
from operator import getitem

from bladerub.config.errors import UNKNOWN, ConfigError, Location
from bladerub.config.files import Located
from bladerub.config.problems import is_number
from bladerub.io.errors import format_value
from bladerub.settings.study import Config


@dataclass(frozen=True)
class Factor:
    """One choice that the paper leaves open."""

    name: str
    unit: str
    ranges: dict[str, tuple[float, float]]  # lowest and highest of each number of the config that it sets
    logarithmic: bool = False  # whether the values are spread evenly on a logarithmic scale
    multiple_of: float | None = None  # values are rounded to a multiple of it
    location: Location = UNKNOWN  # in the plan

    @property
    def range(self) -> tuple[float, float]:
        """Lowest and highest value of the first number that it sets, which stands for all."""
        return next(iter(self.ranges.values()))

    def own(self, config: Config) -> float:
        """Return the value that a config has of the first number."""
        return float(reduce(getitem, _keys(next(iter(self.ranges))), config.plain()))

    def position(self, value: float) -> float:
        """Return the position of a value of the first number; one outside the range lies at its end."""
        low, high = self.range
        value = min(max(value, low), high)
        if self.logarithmic:
            return math.log(value / low) / math.log(high / low)
        return (value - low) / (high - low)

    def first_value(self, position: float) -> float:
        """Return the first number that the factor sets, at a `position` from 0 to 1 of its range."""
        return self._between(*self.range, position)

    def values(self, position: float) -> dict[str, float]:
        """Return each number that the factor sets, at a `position` from 0 to 1 of its range."""
        return {path: self._between(*ends, position) for path, ends in self.ranges.items()}

    def _between(self, low: float, high: float, position: float) -> float:
        if self.logarithmic:
            value = math.exp(math.log(low) + position * math.log(high / low))
        else:
            value = low + position * (high - low)
        if self.multiple_of is None:
            return value
        rounded = round(round(value / self.multiple_of) * self.multiple_of, 9)
        return int(rounded) if float(self.multiple_of).is_integer() else rounded


def read_factors(located: Located) -> tuple[Factor, ...]:
    """Make the factors of a plan from its group ``factors``, which its model has checked.

    Raises `ConfigError` for a range that its scale does not allow, and for a number that two factors set.
    """
    factors = tuple(_factor(name, entry) for name, entry in located.content.items())
    for one, other in itertools.combinations(factors, 2):
        if both := one.ranges.keys() & other.ranges.keys():
            text = f"factors.{other.name}.sets.{min(both)}: is set by another factor, must be by one alone"
            raise ConfigError.at(other.location, text)
    return factors


def lay_over(config: Located, factors: Iterable[Factor], positions: Iterable[float]) -> Located:
    """Set the numbers of all factors, each at its position from 0 to 1, in a copy of `config`.

    A switch of the config is on from 0.5.

    Raises `ConfigError` if a factor sets what the config does not have.
    """
    for factor, position in zip(factors, positions, strict=True):
        for path, value in factor.values(float(position)).items():
            setting = f"factors.{factor.name}.sets.{path}"
            config = _replaced(config, _keys(path), Located(value, factor.location), setting)
    return config


def _factor(name: str, located: Located) -> Factor:
    entry, location = located.plain(), located.location
    logarithmic, step = entry.get("scale") == "log", entry.get("multiple_of")
    for key, ends in entry["sets"].items():
        message = f"factors.{name}.sets.{key} = {format_value(ends)}: must be"
        if logarithmic and ends[0] <= 0:
            raise ConfigError.at(location, f"{message} above 0 on a logarithmic scale")
        if step and any(abs(end / step - round(end / step)) > 1e-6 for end in ends):
            raise ConfigError.at(location, f"{message} multiples of {step:g}, as the values between them are")
    ranges = {key: (float(low), float(high)) for key, (low, high) in entry["sets"].items()}
    return Factor(name, entry["unit"], ranges, logarithmic, step, location)


def _keys(path: str) -> list[str | int]:
    """Split a path such as ``casings.2nd5nd.weights[0]``."""
    return [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]


def _replaced(config: Located, keys: list[str | int], value: Located, setting: str) -> Located:
    """Set the number that `keys` lead to, in a copy."""
    content = config.content
    if not keys:
        if isinstance(content, bool):
            return Located(value.content >= 0.5, value.location)
        if not is_number(content):
            text = f"{setting} = {format_value(config.plain())}: must be a number"
            raise ConfigError.at(value.location, text)
        return value
    members = (
        content if isinstance(content, dict) else range(len(content)) if isinstance(content, list) else ()
    )
    if keys[0] not in members:
        raise ConfigError.at(value.location, f"{setting}: must be a number of the study, it has none there")
    changed = copy.copy(content)
    changed[keys[0]] = _replaced(content[keys[0]], keys[1:], value, setting)
    return Located(changed, config.location)
