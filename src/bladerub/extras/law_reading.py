"""Reads laws of an abradable element beside that of the paper (`bladerub.contact.law`): modules or files.

A law has the functions of `CONTRACT` (docs/laws.md), and a dictionary `PARAMETERS` with unit, range and
meaning of each parameter of its own. That is a literal: configs are checked by it without running the law.
Those that have a name plug in (``LAWS`` of `bladerub.plugins`).
"""

import ast
import dis
import hashlib
import math
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple

from pydantic import TypeAdapter

from bladerub import plugins
from bladerub.contact.laws import NAMES
from bladerub.contact.spec import PLASTIC, ElementLaw
from bladerub.io import sources
from bladerub.io.errors import BadInput
from bladerub.io.folders import PACKAGE, study_folder

_REASON = re.compile("can't resolve|No implementation|Unknown attribute|Invalid use")

CONTRACT = (  # what the module of a law has for the program
    "Element",
    "element",
    "return_mapping",
    "tangent",
    "elastic_force",
    "stored_energy",
    "dissipated_energy",
)


class Parameter(NamedTuple):
    """A parameter of a law."""

    unit: str
    minimum: float
    maximum: float
    meaning: str


_PARAMETERS = TypeAdapter(dict[str, Parameter])


@cache
def source_of(law: ElementLaw) -> str:
    """Return the text of the module of a law, empty for the paper's; `ValueError` if there is none such."""
    if law.source or law.name == PLASTIC.name:
        return law.source
    if law.name not in (offered := plugins.offered("LAWS")):
        raise ValueError(f"name = {law.name}: must be one of {', '.join(NAMES)}")
    return PACKAGE.joinpath(*offered[law.name].split(".")).with_suffix(".py").read_text(encoding="utf-8")


def law_digest(law: ElementLaw) -> dict[str, str]:
    """Digest what loop and spec lack of a law: its module if it plugs in, and what it imports of extras."""
    if not (law.source or law.name in plugins.offered("LAWS")):
        return {}
    source = source_of(law)
    plugs_in = {} if law.source else {"law": hashlib.sha256(source.encode()).hexdigest()}
    imported = [name for name in sources.imports_in(source) if name.startswith("extras.")]
    return plugs_in | ({"law_imports": sources.digest_behind(*imported)} if imported else {})


def compile_error(law: ElementLaw, error: Exception) -> BadInput:
    """Return the error of a law that is refused: the innermost of what the compiler says for each caller."""
    lines = str(error).splitlines() or [type(error).__name__]
    reasons = filter(_REASON.search, lines)
    reason = max(reasons, key=lambda line: len(line) - len(line.lstrip()), default=lines[0])
    place = next((line.strip(" :") for line in lines if line.lstrip().startswith("File ")), "")
    innermost = ", ".join(filter(None, (reason.strip(" :").removeprefix("TypingError: "), place)))
    return BadInput(
        f"law {law.label}: cannot be compiled ({innermost}); its functions are marked elementwise, and "
        "written with + - * / > <= and where, maximum, minimum, absolute and sqrt of "
        "bladerub.numerics.vectors"
    )


def law_of(entry: Mapping[str, Any]) -> ElementLaw:
    """Describe a law by the keys of ``contact.law``; raises `ValueError`, which begins with the key."""
    values = dict(entry)
    name, file = values.pop("name", PLASTIC.name), values.pop("file", None)
    if file is None:
        return described_law(name, values)
    try:
        path = file_of(file)
        source = path.read_text(encoding="utf-8")
        if not source:  # which would stand for a law of the package
            raise ValueError("is empty")
        parameters_of(source)
    except ValueError as error:  # that of a text in another encoding is one
        raise ValueError(f"file = {file}: {error}") from error
    return described_law(path.stem, values, source)


def file_of(name: str) -> Path:
    """Find the file of a law, from the folder of the study; raises `ValueError` if there is none."""
    path = study_folder() / name
    if not path.is_file():
        raise ValueError(f"there is no such file ({path}); a path is from the folder of the study")
    return path


def parameters_in(entry: Mapping[str, Any]) -> Mapping[str, Parameter]:
    """Return the parameters of the law of the block ``contact.law``; raises as `law_of`, or OSError."""
    if entry.get("file"):
        source = file_of(entry["file"]).read_text(encoding="utf-8")
    else:
        source = source_of(ElementLaw(entry.get("name", PLASTIC.name)))
    return parameters_of(source)


@cache
def parameters_of(source: str) -> Mapping[str, Parameter]:
    """Read the parameters of a law from the text of its module, not run; `ValueError` if it is no law."""
    try:
        statements = ast.parse(source).body
        instructions = dis.get_instructions(compile(source, "<law>", "exec", dont_inherit=True))
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise ValueError(f"is no Python ({error or 'nested too deeply'})") from error
    parameters: Mapping[str, Parameter] = {}
    for node in statements:
        if not isinstance(node, ast.Assign | ast.AnnAssign) or node.value is None:
            continue
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        if "PARAMETERS" in (target.id for target in targets if isinstance(target, ast.Name)):
            try:
                parameters = _PARAMETERS.validate_python(ast.literal_eval(node.value))
            except (TypeError, ValueError, RecursionError, MemoryError) as error:
                requirement = "must be a dictionary of name: (unit, minimum, maximum, meaning), written out"
                raise ValueError(f"PARAMETERS on line {node.lineno}: {requirement}") from error
    names = {step.argval for step in instructions if step.opname == "STORE_NAME"}  # not one only annotated
    if source and (missing := [name for name in CONTRACT if name not in names]):
        raise ValueError(f"has no {', '.join(missing)}; a law must have {', '.join(CONTRACT)}")
    if "strength" in names and "Layer" not in names:
        raise ValueError("has strength, but no Layer, which it is for")
    return parameters


def described_law(name: str, values: Mapping[str, Any], source: str = "") -> ElementLaw:
    """Describe a law by name, parameters and source, if a user's; `ValueError` names a bad parameter."""
    rules = parameters_of(source_of(ElementLaw(name, (), source)))
    for key, value in values.items():
        if key not in rules:
            has = f"has {', '.join(rules)}" if rules else "has no parameters of its own"
            raise ValueError(f"{key} = {value}: unknown parameter, the law {name} {has}")
    settings = []
    for parameter, rule in rules.items():
        limits = f"from {rule.minimum:g} to {rule.maximum:g}, in {rule.unit}"
        requirement = f"{rule.meaning}, must be a number {limits}"
        if parameter not in values:
            raise ValueError(f"{parameter}: missing, {requirement}")
        value = values[parameter]
        is_number = isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)
        if not is_number or not rule.minimum <= value <= rule.maximum:
            raise ValueError(f"{parameter} = {value}: {requirement}")
        settings.append((parameter, float(value)))
    return ElementLaw(name, tuple(settings), source)
