"""Each range of the config at its ends: the last value that is allowed, and the first that is not."""

import copy
import math
import re

import numpy as np
import pytest

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, validate
from bladerub.config.schema import schema
from bladerub.io.sources import ROOT

PAPER = load(ROOT / "config" / "config.yaml")


def scalars(rule, value, path=()):
    """Yield path and rule of each number of the config that the schema gives a range."""
    rule = schema()["$defs"][rule["$ref"].rpartition("/")[2]] if "$ref" in rule else rule
    if isinstance(value, dict):
        rules = rule.get("properties", {})
        for key, inner in value.items():
            if key in rules or isinstance(rule.get("additionalProperties"), dict):
                yield from scalars(rules.get(key, rule.get("additionalProperties")), inner, (*path, key))
    elif isinstance(value, list) and value and "items" in rule:
        yield from scalars(rule["items"], value[0], (*path, 0))
    elif rule.get("type") in ("number", "integer"):
        yield path, rule


def borders():
    """Yield path, a value within the range, and the next one that is not, at each end of each range."""
    for path, rule in scalars(schema(), PAPER):
        for end, direction in (("inimum", -1), ("aximum", 1)):
            is_open = f"exclusiveM{end}" in rule
            border = rule[f"exclusiveM{end}" if is_open else f"m{end}"]
            further = next_number(border, -direction if is_open else direction, rule["type"])
            yield path, *((further, border) if is_open else (border, further))


def next_number(value, direction, kind):
    return value + direction if kind == "integer" else math.nextafter(value, direction * math.inf)


def problems(path, value, others=()):
    """Problems that name the key at `path` when it has this value, and those in `others` theirs."""
    config = copy.deepcopy(PAPER)
    for keys, new in [(path, value), *others]:
        part = config
        for key in keys[:-1]:
            part = part[key]
        part[keys[-1]] = new
    name = "".join(f"[{key}]" if isinstance(key, int) else f".{key}" for key in path)[1:]
    try:
        validate(config)
    except ConfigError as error:
        return [problem.text for problem in error.problems if problem.text.startswith(f"{name} = ")]
    return []


@pytest.mark.parametrize(
    ("path", "inside", "outside"),
    [pytest.param(*case, id=f"{'.'.join(map(str, case[0]))}={case[2]:g}") for case in borders()],
)
def test_each_range_ends_where_the_schema_says(path, inside, outside):
    of_the_range = re.compile(" must be a (whole )?number")
    assert not any(map(of_the_range.search, problems(path, inside)))
    assert any(map(of_the_range.search, problems(path, outside)))


CONTACT, CASING, SOLVER = ("contact",), ("casings", "2nd"), ("solver",)
ANALYSIS, SPEEDS = ("analysis",), ("speeds",)
SHALLOW = [((*CASING, "amplitude"), 0.01)]


@pytest.mark.parametrize(
    ("path", "inside", "outside", "others"),
    [
        # of the tip and its casing
        ((*CONTACT, "tip_profile", "half_width"), 20.0, np.nextafter(20.0, 21), ()),
        ((*CONTACT, "tip_profile", "half_width"), 5e-324, 0.0, ()),
        ((*CONTACT, "tip_profile", "half_width"), 12.5, 12.6, [((*CONTACT, "elements"), 100)]),
        ((*CASING, "interference"), np.nextafter(6e-3, 0), 6e-3, SHALLOW),
        ((*CASING, "interference"), 2e-3, np.nextafter(2e-3, 1), ()),
        ((*CASING, "interference"), np.nextafter(1.5e-4 * 0.2, 1), 1.5e-4 * 0.2, ()),
        ((*CASING, "nodal_diameters", 0), 50, 51, [((*CONTACT, "elements"), 100)]),
        # of the speeds
        ((*SPEEDS, "stop"), 0.4, np.nextafter(0.4, 1), ()),
        ((*SPEEDS, "stop"), 0.3, 0.29, [((*SPEEDS, "start"), 0.3)]),
        (("chart", "speeds", "start"), 0.399, 0.4, ()),
        (("sweeps", "stop"), 0.141, 0.14, ()),
        (("sweeps", "stop"), 0.4, np.nextafter(0.4, 1), ()),
        # of what is measured
        ((*ANALYSIS, "spectrum_revolutions"), 20, 21, ()),
        ((*ANALYSIS, "divergence", "revolutions"), 20, 21, ()),
        ((*ANALYSIS, "divergence", "confirmation_revolutions"), 30, 29, ()),
        ((*ANALYSIS, "divergence", "confirmation_revolutions"), 10_000, 10_001, ()),
        ((*ANALYSIS, "max_order"), 1000.0, 1000.1, ()),
        ((*ANALYSIS, "peaks", "orders", 0), 60, 61, ()),
        ((*ANALYSIS, "peaks", "orders", 0), 3, 2, ()),
        (("reduction", "accuracy_modes"), 30, 31, ()),
        ((*SOLVER, "revolutions"), 2000, 2001, [((*CONTACT, "elements"), 10_000)]),
    ],
)
def test_values_are_compared_with_other_keys_at_the_border(path, inside, outside, others):
    assert problems(path, inside, others) == []
    assert problems(path, outside, others) != []


@pytest.mark.parametrize(
    ("mesh", "is_allowed"),
    [((50, 10, 40), True), ((50, 10, 41), False), ((7, 1, 2), True), ((6, 1, 2), False)],
)
def test_the_mesh_has_as_many_elements_as_fit_the_memory_and_eight_nodes_at_the_tip(mesh, is_allowed):
    config = copy.deepcopy(PAPER)
    config["blade"]["mesh"] = dict(zip(("chordwise", "thickness", "spanwise"), mesh, strict=True))
    if is_allowed:
        validate(config)
    else:
        with pytest.raises(ConfigError, match=r"blade\.mesh"):
            validate(config)


def test_order_is_asked_of_numbers_alone():
    config = copy.deepcopy(PAPER)
    config["analysis"]["peaks"]["speed_window"] = [1.35, "0.85"]
    with pytest.raises(ConfigError) as error:
        validate(config)
    (problem,) = error.value.problems
    assert problem.text.startswith('analysis.peaks.speed_window[1] = "0.85": ')
