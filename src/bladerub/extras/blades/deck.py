"""Decks of Abaqus and CalculiX as blocks, a keyword with its parameters and the lines below; their material.

Comments are left out, files of ``*INCLUDE`` and of the parameter ``INPUT`` are read where they are named, as
seen from the folder of the deck. Keywords and names of parameters are in capitals; a keyword line that ends
with a comma goes on in the next line.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from bladerub.extras.cells import UNITS
from bladerub.settings.blade import Material

MOST_FILES = 100
_FORCES = dict.fromkeys(("inch", "in", "feet", "ft"), 4.4482216152605)  # N, where a unit is not of N
_YOUNG = (1e9, 1e12)  # Pa, from plastics to ceramics
_DENSITY = (500.0, 25e3)  # kg/m³, as blade.material.density of the config
_POISSON = (0.05, 0.49)


class Line(NamedTuple):
    """A line of data."""

    text: str
    place: str  # for messages: its number, with the file if that is included

    def cells(self) -> list[str]:
        """Cells between commas, without the empty one behind a comma at the end."""
        cells = [cell.strip().strip('"') for cell in self.text.split(",")]
        return cells if cells[-1] else cells[:-1]


class Block(NamedTuple):
    """A keyword and what belongs to it."""

    keyword: str  # with its star, as ``*SOLID SECTION``
    parameters: dict[str, str]  # without quotes, empty where there is no equals sign
    place: str
    in_part: bool  # between ``*PART`` and ``*END PART``
    lines: list[Line]


def number(text: str) -> float:
    """Read a number, whose exponent may have a D; empty is 0. Raises ValueError."""
    return float(re.sub("[dD]", "e", text)) if text else 0.0


def blocks(path: Path) -> list[Block]:
    """Read the blocks of the deck at `path`; a ValueError names the line of a file that is not there."""
    content: list[Block] = []
    in_part = False
    for line in _lines(path, path.parent, (path.resolve(),)):
        if line.text.startswith("*"):
            keyword, parameters = _head(line.text)
            in_part = keyword == "*PART" or (in_part and keyword != "*END PART")
            if keyword != "*INCLUDE":
                content.append(Block(keyword, parameters, line.place, in_part, []))
        elif content:
            content[-1].lines.append(line)
    return content


def included(path: Path) -> list[str]:
    """List the files that the deck at `path` reads, relative to its folder; raises ValueError as `blocks`."""
    lines = _lines(path, path.parent, (path.resolve(),))
    parameters = [_head(line.text)[1] for line in lines if line.text.startswith("*")]
    return list(dict.fromkeys(_file_name(names["INPUT"]) for names in parameters if "INPUT" in names))


def _file_name(name: str) -> str:
    """Name of an included file with slashes: decks written on Windows have backslashes."""
    return name.replace("\\", "/")


def _head(text: str) -> tuple[str, dict[str, str]]:
    """Keyword and parameters of a keyword line."""
    keyword, *words = text.split(",")
    pairs = (word.partition("=") for word in words if word.strip())
    parameters = {" ".join(key.upper().split()): value.strip().strip('"') for key, _, value in pairs}
    return "*" + " ".join(keyword.strip("* ").upper().split()), parameters


def _lines(path: Path, folder: Path, chain: tuple[Path, ...]) -> Iterator[Line]:
    """Yield keyword lines, each whole in one, and lines of data; below a keyword those of its ``INPUT``."""
    prefix = f"{path.name}, " if len(chain) > 1 else ""
    head = ""
    with path.open(encoding="utf-8-sig", errors="replace") as stream:
        for count, raw in enumerate(stream, 1):
            text = raw.strip()
            if not text or text.startswith("**"):
                continue
            if not head and not text.startswith("*"):
                yield Line(text, f"{prefix}line {count}")
                continue
            head = f"{head} {text}" if head else text
            if head.endswith(","):
                continue
            line, head = Line(head, f"{prefix}line {count}"), ""
            yield line
            if (name := _head(line.text)[1].get("INPUT")) is not None:
                inner, inclusion = folder / _file_name(name), f"{line.place}: it includes {name}, which"
                if not inner.is_file():
                    raise ValueError(f"{inclusion} is not in the folder of the deck")
                if inner.resolve() in chain or len(chain) >= MOST_FILES:
                    raise ValueError(f"{inclusion} includes itself")
                yield from _lines(inner, folder, (*chain, inner.resolve()))


def material(path: Path, unit: str) -> Material | None:
    """Read the block ``blade.material`` of the config, SI, from the deck at `path`; None if there is none.

    `unit` of `UNITS` is that of length; force and mass go with it and the second (mm: N and t). Raises
    ValueError if it cannot be one isotropic material.
    """
    if path.suffix.lower() != ".inp":
        return None
    values = {name: _si(name, constants, unit) for name, constants in _materials(path).items()}
    first = next(iter(values.values()), None)
    if any(value != first for value in values.values()):
        raise ValueError(f"it has the materials {', '.join(values)}, not one")
    return first


def _materials(path: Path) -> dict[str, dict[str, list[str]]]:
    """Lines of *ELASTIC and of *DENSITY by the name of the material, of those that solid sections use."""
    materials, used, name = {}, [], None
    for keyword, parameters, *_, data in blocks(path):
        if keyword == "*MATERIAL":
            name = parameters.get("NAME", "").upper()
            if name in materials:
                raise ValueError(f"it has the material {name} twice")
            materials[name] = {"*ELASTIC": [], "*DENSITY": []}
        elif keyword == "*SOLID SECTION":
            used.append(parameters.get("MATERIAL", "").upper())
        elif keyword in materials.get(name, ()):
            kind = parameters.get("TYPE", "ISO").upper()
            if not kind.startswith("ISO"):
                raise ValueError(f"{keyword} of {name} is of type {kind}, not isotropic")
            materials[name][keyword] += [line.text for line in data]
    if absent := [name for name in used if name not in materials] if materials else []:
        raise ValueError(f"a *SOLID SECTION has the material {absent[0]}, which is not there")
    return {name: materials[name] for name in used if materials} or materials


def _si(name: str, constants: dict[str, list[str]], unit: str) -> Material:
    numbers = []
    for keyword, n in (("*ELASTIC", 2), ("*DENSITY", 1)):
        text = " / ".join(constants[keyword])
        if not text:
            raise ValueError(f"material {name} has no {keyword}")
        try:
            values = [number(word) for word in re.split(r"[,\s]+", text) if word]
        except ValueError:  # several lines, too
            values = []
        if not n <= len(values) <= n + 1:  # a temperature may follow
            raise ValueError(f"{keyword} of {name} is {text[:60]}, must be {n} numbers, a temperature aside")
        numbers += values[:n]
    length, force = UNITS[unit], _FORCES.get(unit, 1.0)
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
