"""The material in a deck of Abaqus or CalculiX, whose units are those of its length."""

import re
from pathlib import Path

from bladerub.extras.blades import deck
from bladerub.extras.blades.frame import FORCES
from bladerub.extras.cells import UNITS
from bladerub.settings.blade import Material

_YOUNG = (1e9, 1e12)  # Pa, from plastics to ceramics
_DENSITY = (500.0, 25e3)  # kg/m³, as blade.material.density of the config
_POISSON = (0.05, 0.49)


def read(path: str | Path, unit: str) -> Material | None:
    """Read the block ``blade.material`` of the config, in SI units, from the deck at `path`.

    `unit` of `UNITS` is that of length; force and mass go with it and the second (mm: N and t). None if the
    file is no deck, or has no material. Raises ValueError if it cannot be one isotropic material.
    """
    if Path(path).suffix.lower() != ".inp":
        return None
    materials = _materials(Path(path))
    if not materials:
        return None
    values = {name: _si(name, *constants, unit) for name, constants in materials.items()}
    first, *others = values
    if any(values[name] != values[first] for name in others):
        raise ValueError(f"it has the materials {', '.join(values)}, not one")
    return values[first]


def _materials(path: Path) -> dict[str, tuple[list[str], list[str]]]:
    """Lines of *ELASTIC and of *DENSITY by the name of the material, of those that solid sections use."""
    materials, used, name = {}, [], None
    for keyword, parameters, _, data in deck.blocks(path):
        lines = [line.text for line in data]
        if keyword == "*MATERIAL":
            name = parameters.get("NAME", "").upper()
            if name in materials:
                raise ValueError(f"it has the material {name} twice")
            materials[name] = ([], [])
        elif keyword == "*SOLID SECTION":
            used.append(parameters.get("MATERIAL", "").upper())
        elif keyword == "*ELASTIC" and name is not None:
            kind = parameters.get("TYPE", "ISO").upper()
            if not kind.startswith("ISO"):
                raise ValueError(f"*ELASTIC of {name} is of type {kind}, not isotropic")
            materials[name][0].extend(lines)
        elif keyword == "*DENSITY" and name is not None:
            materials[name][1].extend(lines)
    if absent := [name for name in used if name not in materials] if materials else []:
        raise ValueError(f"a *SOLID SECTION has the material {absent[0]}, which is not there")
    return {name: materials[name] for name in used} or materials


def _si(name: str, elastic: list[str], density: list[str], unit: str) -> Material:
    numbers = []
    for keyword, lines, n in (("*ELASTIC", elastic, 2), ("*DENSITY", density, 1)):
        if not lines:
            raise ValueError(f"material {name} has no {keyword}")
        if len(lines) > 1:
            raise ValueError(f"{keyword} of {name} is a table of {len(lines)} lines, of temperature or else")
        words = [word for word in re.split(r"[,\s]+", lines[0]) if word]
        try:
            numbers += [deck.number(word) for word in words[:n]]
        except ValueError:
            raise ValueError(f"{keyword} of {name} is {lines[0]}, not numbers") from None
        if not n <= len(words) <= n + 1:  # a temperature may follow
            raise ValueError(f"{keyword} of {name} is {lines[0]}, must be {n} numbers, a temperature aside")
    length, force = UNITS[unit], FORCES.get(unit, 1.0)
    young, poisson, dense = numbers[0] * force / length**2, numbers[1], numbers[2] * force / length**4
    for text, value, (low, high) in (
        (f"a Young modulus of {numbers[0]:g} is {young:.3g} Pa", young, _YOUNG),
        (f"a Poisson ratio of {poisson:g}", poisson, _POISSON),
        (f"a density of {numbers[2]:g} is {dense:.3g} kg/m³", dense, _DENSITY),
    ):
        if not low <= value <= high:
            raise ValueError(f"{text} with the unit {unit}; must be from {low:g} to {high:g}")
    young, dense = float(f"{young:.10g}"), float(f"{dense:.10g}")
    return Material(young_modulus=young, poisson_ratio=poisson, density=dense)
