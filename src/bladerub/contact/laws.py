"""Laws of an abradable element beside that of the paper (`bladerub.contact.law`), each a module or a file.

A law has the functions of `bladerub.contact.law` (docs/laws.md has the contract), and a dictionary
`PARAMETERS` with unit, range and meaning of each parameter of its own. That is a literal: configs are checked
by it without running the law. The time loop is compiled with the law in it
(`bladerub.contact.variants`). Those that have a name plug in (``LAWS`` of `bladerub.plugins`).
"""

import ast
import hashlib
import math
from collections.abc import Mapping
from contextlib import nullcontext
from functools import cache
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from bladerub import plugins
from bladerub.contact.spec import PLASTIC, Coating, ElementLaw
from bladerub.contact.variants import module_for
from bladerub.io import sources
from bladerub.io.folders import PACKAGE
from bladerub.numerics.lanes import USUAL
from bladerub.numerics.user_code import bounded

NAMES = (PLASTIC.name, *sorted(plugins.offered("LAWS")))
"""Laws that a config may name."""
CONTRACT = (
    *("Element", "element", "return_mapping", "tangent", "elastic_force"),
    *("stored_energy", "dissipated_energy"),
)
"""What the module of a law has for the program."""


class Parameter(NamedTuple):
    """A parameter of a law."""

    unit: str
    minimum: float
    maximum: float
    meaning: str


def source_of(law: ElementLaw) -> str:
    """Return the text of the module of a law; it is empty for that of the paper, which the loop has.

    Raises `ValueError`, which names the law, if there is none of its name.
    """
    if law.source or law.name == PLASTIC.name:
        return law.source
    return _source_in_package(law.name)


def law_digest(law: ElementLaw) -> dict[str, str]:
    """Digest what loop and spec lack of a law: its module if it plugs in, and what it imports of extras."""
    if not (law.source or law.name in plugins.offered("LAWS")):
        return {}
    source = source_of(law)
    plugs_in = {} if law.source else {"law": hashlib.sha256(source.encode()).hexdigest()}
    imported = [name for name in sources.imports_in(source) if name.startswith("extras.")]
    return plugs_in | ({"law_imports": sources.digest_behind(*imported)} if imported else {})


def module_of(law: ElementLaw) -> ModuleType:
    """Return the module of a law, whose functions are those of `bladerub.contact.law`."""
    return module_for(USUAL, "contact.law", source_of(law))


def element_parameters(coating: Coating, area: np.ndarray, time_step: float = math.inf) -> np.ndarray:
    """Return the parameters (p, n) of elements of the cross-sections `area` (n,), m², by the coating's law.

    A parameter that is one number for all is repeated. Raises `ValueError` on anything but finite numbers in
    the fields of the law's ``Element``, and on what the law itself raises.
    """
    law, name = module_of(coating.element_law), coating.element_law.name
    with bounded(f"law {name}: element") if coating.element_law.source else nullcontext():
        fields, parameters = law.Element._fields, tuple(law.element(coating, area, time_step))
    if "elastic" not in fields:
        raise ValueError(f"law {name}: Element has no elastic, which gives the stiffness of an element")
    if len(parameters) != len(fields):
        raise ValueError(f"law {name}: element returns {len(parameters)} parameters, must be {len(fields)}")
    rows = np.empty((len(fields), area.size))
    for row, field, value in zip(rows, fields, parameters, strict=True):
        try:
            row[:] = np.squeeze(value) if np.isrealobj(value) else np.nan
            wrong = "" if np.isfinite(row).all() else "no finite number"
        except (TypeError, ValueError):
            wrong = f"an array of shape {np.shape(value)}"
        if wrong:
            requirement = f"must be a finite number, or one for each of {area.size} areas"
            raise ValueError(f"law {name}: element gives {wrong} as {field}; {requirement}")
    return rows


@cache
def parameters_of(source: str) -> Mapping[str, Parameter]:
    """Read the parameters of a law from the text of its module, which is not run.

    Raises `ValueError` if it is no Python, lacks a part of `CONTRACT` or its ``PARAMETERS`` are not as they
    must be.
    """
    parameters: Mapping[str, Parameter] = {}
    for node in _statements(source):
        if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", None) == "PARAMETERS":
            try:
                parameters = {
                    name: Parameter(*map(_plain, entry.elts)) for name, entry in _entries(node.value)
                }
            except (AttributeError, TypeError, ValueError, RecursionError, MemoryError) as error:
                requirement = "must be a dictionary of name: (unit, minimum, maximum, meaning), written out"
                raise ValueError(f"PARAMETERS on line {node.lineno}: {requirement}") from error
    names = _names_in(source)
    if source and (missing := [name for name in CONTRACT if name not in names]):
        raise ValueError(f"has no {', '.join(missing)}; a law must have {', '.join(CONTRACT)}")
    if "strength" in names and "Layer" not in names:
        raise ValueError("has strength, but no Layer, which it is for")
    return parameters


def described_law(name: str, values: Mapping[str, Any], source: str = "") -> ElementLaw:
    """Describe a law by its name, the values of its parameters and, if it is a user's own, its source.

    Raises `ValueError`, which names the parameter, if one is missing, unknown or out of its range; and as
    `parameters_of`.
    """
    rules = parameters_of(source_of(ElementLaw(name, (), source)))
    for key, value in values.items():
        if key not in rules:
            has = f"this law has {', '.join(rules)}" if rules else "this law has no parameters of its own"
            raise ValueError(f"{key} = {value}: unknown parameter, {has}")
    settings = []
    for parameter, rule in rules.items():
        requirement = (
            f"{rule.meaning}, must be a number from {rule.minimum:g} to {rule.maximum:g}, in {rule.unit}"
        )
        if parameter not in values:
            raise ValueError(f"{parameter}: missing, {requirement}")
        value = values[parameter]
        is_number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        if not is_number or not rule.minimum <= value <= rule.maximum:
            raise ValueError(f"{parameter} = {value}: {requirement}")
        settings.append((parameter, float(value)))
    return ElementLaw(name, tuple(settings), source)


@cache
def _source_in_package(name: str) -> str:
    place = plugins.offered("LAWS").get(name)
    if place is None:
        raise ValueError(f"name = {name}: must be one of {', '.join(NAMES)}")
    return PACKAGE.joinpath(*place.split(".")).with_suffix(".py").read_text(encoding="utf-8")


def _statements(source: str) -> list[ast.stmt]:
    try:
        return ast.parse(source).body
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise ValueError(f"is no Python ({error or 'nested too deeply'})") from error


def _names_in(source: str) -> set[str]:
    """Names that a module defines or imports at its top."""
    names = set()
    for node in _statements(source):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            names.add(node.name)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            names |= {alias.asname or alias.name for alias in node.names}
        elif isinstance(node, ast.Assign):
            names |= {target.id for target in node.targets if isinstance(target, ast.Name)}
    return names


def _entries(node: Any) -> list[tuple[str, Any]]:
    return [(ast.literal_eval(key), value) for key, value in zip(node.keys, node.values, strict=True)]


def _plain(node: ast.expr) -> Any:
    return ast.literal_eval(node)
