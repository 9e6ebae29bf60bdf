"""Quantities typed with a unit become the numbers that they stand for, wherever the schema has a number."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

from bladerub.config import units
from bladerub.config.errors import top_key
from bladerub.config.files import Located
from bladerub.config.schema import inner, problems, resolved, schema
from bladerub.io.folders import study_folder
from bladerub.study.grid import SPEED_DECIMALS, UNSCALED, modulus_unit

Rule = Mapping[str, Any]

_READS = {"f1": {"blade", "reduction"}, "modulus_unit": {"contact"}, "blade lengths": {"blade"}}
"""Keys at the top of the config that say what a reference is; `UNSCALED` ones are of ``contact``."""


class Unknown(ValueError):
    """The config does not say what a reference is, for a problem of its own."""


def references(config: Mapping[str, Any], f1_hz: float | None = None) -> units.Reference:
    """Return the sizes of a study that quantities are divided by, as `bladerub.config.units.convert` asks.

    The first frequency is that of the blade of the config unless `f1_hz` is given: ValueError or OSError if
    that cannot be computed.
    """

    def size(name: str) -> float:
        if name == "f1":
            from bladerub.blade.cache import first_frequency, rounded_frequency  # imports the solver

            return rounded_frequency(f1_hz) if f1_hz else first_frequency(config)
        if name == "modulus_unit":
            return modulus_unit(config)
        if name == "blade lengths":
            return float(config["blade"]["length"])
        return float(config["contact"].get("scale", UNSCALED)[name])

    return size


def number(name: str, value: Any, reference: units.Reference) -> Any:
    """Return `value` as a plain number if it is a quantity with a unit, anything else as it is.

    `name` is that of a definition of the schema, such as ``E``, or of a key of ``rotor``. A speed is rounded
    as those of the grid. Raises ValueError if the unit is of another kind, and as the `reference`.
    """
    quantity = units.read(value)
    if quantity is None:
        return value
    rule = schema()["$defs"].get(name) or schema()["properties"]["rotor"]["properties"][name]
    plain = units.convert(quantity, rule, reference)
    return round(plain, SPEED_DECIMALS) if name == "f_omega" else plain


def law_numbers(law: str, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters of a law, by its name or file, with plain numbers instead of quantities.

    What cannot be converted stays as it is, for the law to refuse.
    """
    rules, plain = _law_rules({"file" if law.endswith(".py") else "name": law}), dict(values)
    for name, value in values.items():
        if name in rules and (quantity := units.read(value)):
            with suppress(ValueError):
                plain[name] = units.convert(quantity, rules[name], _no_reference)
    return plain


def converted(
    config: Located, definition: str | None = None, study: Mapping[str, Any] | None = None
) -> tuple[Located, list[str]]:
    """Return a config with plain numbers instead of quantities, and why a reference is not known, if so.

    A quantity of another kind than it must be, or of a reference that is not known, stays as it is: the
    schema refuses it.

    Parameters
    ----------
    config : Located
        A config, or a plan of this `definition` of the schema.
    definition : str, optional
        What a plan is.
    study : mapping, optional
        The checked config that a plan is for, whose references it has. Those of a config are its own.
    """
    rule = schema()["$defs"][definition] if definition else schema()
    wanted: set[str] = set()

    def note(name: str) -> float:
        wanted.add(name)
        raise Unknown

    config = _converted(config, rule, note)
    if not wanted or (definition and study is None):
        return config, []
    size_of = references(study or config.plain())
    sizes, reasons = {}, []
    for name in sorted(wanted):
        try:
            if not study:
                _require_sound(config, _READS.get(name, {"contact"}))
            sizes[name] = size_of(name)
        except Unknown:
            continue
        except (ValueError, OSError) as error:
            reasons.append(f"blade: no first frequency, which speeds in rpm need: {error}")

    def known(name: str) -> float:
        if name not in sizes:
            raise Unknown
        return sizes[name]

    return _converted(config, rule, known), reasons


def as_typed(typed: Located, config: Located) -> Callable[[str], str]:
    """Return what adds to the text of a problem the quantity that was typed, where `config` has a number."""
    before, after = typed.values(), config.values()
    quantities = {path: text for path, text in before.items() if after.get(path) != text}

    def add(problem: str) -> str:
        setting, colon, right = problem.partition(": ")
        path = setting.partition(" = ")[0]
        return f"{setting} ({quantities[path]}){colon}{right}" if path in quantities else problem

    return add


def _require_sound(config: Located, parts: set[str]) -> None:
    """Raise `Unknown` where a key at the top in `parts` has a problem, but for quantities to be converted."""
    from bladerub.config.checks import check  # takes half a second to import

    values = _converted(config, schema(), _no_reference, lambda rule: rule["maximum"]).plain()
    others = schema()["properties"].keys() - parts
    if any(top_key(text) in parts for text in problems(values)) or check(values, others):
        raise Unknown


def _no_reference(name: str) -> float:
    raise Unknown


def _converted(
    entry: Located,
    rule: Rule | None,
    reference: units.Reference,
    instead: Callable[[Rule], float] | None = None,
) -> Located:
    """Convert all that is in `entry`, with `instead` of a quantity whose reference is unknown."""
    if rule is None:
        return entry
    rule, content = resolved(rule), entry.content
    if isinstance(content, dict):
        own = _law_rules(entry.plain()) if rule is _law() else {}
        values = {
            key: _converted(value, own.get(key) or inner(rule, key), reference, instead)
            for key, value in content.items()
        }
        return Located(values, entry.location)
    if isinstance(content, list):
        values = [_converted(value, inner(rule, None), reference, instead) for value in content]
        return Located(values, entry.location)
    if rule.get("type") == "number" and (quantity := units.read(content)):
        try:
            return Located(units.convert(quantity, rule, reference), entry.location)
        except Unknown:
            return Located(instead(rule), entry.location) if instead else entry
        except ValueError:
            return entry
    return entry


def _law() -> Rule:
    return schema()["properties"]["contact"]["properties"]["law"]


def _law_rules(law: Mapping[str, Any]) -> dict[str, Rule]:
    """Give the parameters of ``contact.law`` their units, which its schema does not know."""
    from bladerub.contact.laws import parameters_of, source_of
    from bladerub.contact.spec import ElementLaw

    try:
        file = law.get("file")
        source = (study_folder() / file).read_text(encoding="utf-8") if file else ""
        parameters = parameters_of(source or source_of(ElementLaw(law.get("name", "plastic"))))
    except (OSError, ValueError, TypeError):  # which the law's own check says
        return {}
    return {name: {"type": "number", "unit": parameter.unit} for name, parameter in parameters.items()}
