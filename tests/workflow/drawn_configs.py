"""Configs drawn by the schema: a few of its keys with other values, in their bounds or wild.

`draw` changes the study by the rules of ``config/schema.yaml``, so that a new key is drawn as well; whole
casings, coatings and speeds come from `_coherent`, since few of those that are drawn key by key agree.
"""

import math
import random
import re
from copy import deepcopy
from itertools import pairwise
from typing import Any

from bladerub.config.schema import schema

WILD = [
    *(None, True, "", "x", "020", "1:30", "1,5", "../x", "a b", "ü\u202e", "~", "[1]", "x" * 2000, "é" * 300),
    *(math.nan, math.inf, -math.inf, -1, 0, 0.5, 1e-320, 1e308, 10**30, 10**400, 2**63),
    *(
        [],
        {},
        [[]],
        [None],
        [1] * 3000,
        {"x": {"x": {}}},
        {"": 0},
        ["a", {"b": [1, 2]}],
        [1, 1],
        {"file": "x"},
    ),
]


def draw(config: dict[str, Any], seed: int, wild: bool = False) -> dict[str, Any]:
    """Return what a file says that changes one to four keys of `config`; a `wild` one has any values."""
    chance = random.Random(seed)
    overlay: dict[str, Any] = {} if wild or chance.random() < 0.3 else _coherent(chance)
    for _ in range(chance.randint(1, 4)):
        path, rule, value = chance.choice(list(_leaves(schema(), (), {**config, **overlay})))
        drawn = chance.choice(WILD) if wild else _value(rule, value, chance)
        _put(overlay, config, path, drawn)
    return overlay


def _put(overlay: dict[str, Any], config: Any, path: tuple, value: Any) -> None:
    """Set a value; a list that it is in is replaced as a whole, as files do."""
    at: Any = overlay
    for part, following in pairwise([*path, None]):
        if isinstance(at, list) != isinstance(part, int) or (isinstance(at, list) and part >= len(at)):
            return  # something else was drawn there before
        is_known = part < len(config) if isinstance(config, list) else part in (config or ())
        config = config[part] if is_known else None
        if following is None:
            at[part] = value
        elif not isinstance(at, list) and part not in at:
            at[part] = deepcopy(config) if isinstance(config, list) else {}
        at = at[part]
        if not isinstance(at, list | dict):
            return


def _leaves(rule: Any, path: tuple, value: Any) -> Any:
    """Yield path, rule and value of all that may be set: what `value` has, and what it may have besides."""
    if "$ref" in rule:
        rule = schema()["$defs"][rule["$ref"].rsplit("/", 1)[1]]
    if path:
        yield path, rule, value
    for name, inner in rule.get("properties", {}).items():
        known = isinstance(value, dict) and name in value
        if known or "properties" not in inner:
            yield from _leaves(inner, (*path, name), value[name] if known else None)
    named = rule.get("additionalProperties")
    kinds = (
        [branch["then"] for branch in named["allOf"]] if isinstance(named, dict) and "allOf" in named else []
    )
    if isinstance(value, dict) and kinds:
        for name, entry in value.items():
            kind = kinds["table" in entry] if isinstance(entry, dict) else kinds[0]
            yield from _leaves(kind, (*path, name), entry)
    if isinstance(value, list) and "items" in rule and "allOf" not in rule["items"]:
        for index, entry in enumerate(value[:3]):
            yield from _leaves(rule["items"], (*path, index), entry)


def _value(rule: Any, value: Any, chance: random.Random) -> Any:
    """Draw a value that the rule allows, or leave the one there is."""
    kind = rule.get("type")
    if kind in ("number", "integer"):
        low = rule.get("minimum", rule.get("exclusiveMinimum", 0))
        high = rule.get("maximum", rule.get("exclusiveMaximum", 1e3))
        near = (
            value * 2 ** chance.uniform(-1, 1)
            if isinstance(value, int | float)
            else chance.uniform(low, high)
        )
        drawn = min(max(chance.choice([low, high, chance.uniform(low, high), near, near, near]), low), high)
        return round(drawn) if kind == "integer" else float(f"{drawn:.6g}")
    if kind == "boolean":
        return chance.random() < 0.5
    choices = re.fullmatch(r"\^\(([\w|]+)\)\$", rule.get("pattern", ""))
    if choices:
        return chance.choice(choices[1].split("|"))
    if kind == "array" and isinstance(rule.get("items"), dict) and "allOf" not in rule["items"]:
        inner = rule["items"]
        if "$ref" in inner:
            inner = schema()["$defs"][inner["$ref"].rsplit("/", 1)[1]]
        if inner.get("type") in ("number", "integer"):
            number = chance.randint(max(rule.get("minItems", 0), 1), min(rule.get("maxItems", 3), 3))
            seeds = value if isinstance(value, list) and value else [None]
            drawn = [_value(inner, chance.choice(seeds), chance) for _ in range(number)]
            return sorted(set(drawn)) if "ascending" in rule or rule.get("uniqueItems") else drawn
    if kind == "array" and isinstance(value, list):
        return value[: chance.randint(rule.get("minItems", 0), len(value))]
    return value


def _coherent(chance: random.Random) -> dict[str, Any]:
    """Draw casings, coatings on them and speeds that agree with each other more often than not."""
    overlay: dict[str, Any] = {}
    names = ["2nd", "2nd5nd"]
    if chance.random() < 0.7:
        names = [chance.choice(["oval", "three", "Casing9", "2nd"]) for _ in range(chance.randint(1, 2))]
        overlay["casings"] = {name: _casing(chance) for name in names}
    if chance.random() < 0.8 or "casings" in overlay:
        overlay["coatings"] = [_coating(chance, name) for name in dict.fromkeys(names)]
    if chance.random() < 0.6:
        start = chance.choice([0.02, 0.1, 0.14, 0.3])
        stop = min(0.4, start + chance.choice([0.1, 0.2, 0.3]))
        extra = [float(f"{chance.uniform(start, stop):.4f}") for _ in range(chance.randint(0, 3))]
        overlay["speeds"] = {
            "start": start,
            "stop": stop,
            "step": chance.choice([0.005, 0.01, 0.05]),
            "extra": extra,
        }
        if chance.random() < 0.3:
            overlay["speeds"] |= {"start": 0.3, "stop": 0.8, "step": 0.1}
            overlay["reduction"] = {"f_omega_max": 0.8}
    if chance.random() < 0.2:
        overlay["rotor"] = {"blades": chance.randint(1, 12), "coupling": [0.01], "length_scatter": 1e-5}
    if chance.random() < 0.2:
        overlay["contact"] = {"law": {"name": "viscoplastic", "viscosity": 1e4}}
    return overlay


def _casing(chance: random.Random) -> dict[str, Any]:
    diameters = chance.sample([1, 2, 3, 4, 5, 7, 8, 12, 20], chance.randint(1, 3))
    casing = {
        "nodal_diameters": diameters,
        "weights": [round(chance.uniform(0.1, 1), 3) for _ in diameters],
        "amplitude": float(f"{chance.uniform(2e-4, 1e-3):.3g}"),
        "interference": float(f"{chance.uniform(1e-4, 4e-4):.3g}"),
        "start_angle": chance.choice([0.0, 90.0, -12.5]),
    }
    if chance.random() < 0.2:
        casing["bump_width"] = 0.2
    if chance.random() < 0.5:
        casing["peak_orders"] = sorted(chance.sample(range(3, 25), chance.randint(1, 3)))
    return casing


def _coating(chance: random.Random, casing: str) -> dict[str, Any]:
    kind = chance.randrange(3)
    if kind == 0:
        return {"casing": casing, "coating": "rigid", "friction": [chance.choice([0.0, 0.15])]}
    entry: dict[str, Any] = {
        "casing": casing,
        "E": sorted({round(chance.uniform(0.1, 20), 2) for _ in range(2)}),
    }
    entry["K"] = chance.choice([[0.5], [0, 5], [0.05, 1e-5]])
    entry["theta" if kind == 1 else "friction"] = [chance.choice([0.0, 0.15])]
    if chance.random() < 0.3:
        entry["damping_ratio"] = [1e-3, 2e-3]
    return entry
