"""What limits a value: bounds, and other keys, with values at the border, just inside and just outside."""

import copy
import math
import re

import numpy as np
import pytest
from study_fixtures import CONFIG

from bladerub import plugins
from bladerub.config.keys import NUMBERS, key_of
from bladerub.config.problems import problems
from bladerub.config.read import load
from bladerub.io.folders import PACKAGE, ROOT
from bladerub.settings.fields import Section
from bladerub.settings.study import defaults, required, whole


def just_above(value):
    return math.nextafter(value, math.inf)


def change(config, path, value):
    *parents, key = [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]
    for parent in parents:
        config = config[parent]
    config[key] = copy.deepcopy(value)


CLEARANCE = CONFIG.contact.clearance.leading_edge * CONFIG.blade.length
WAVES = np.cos(np.outer(np.linspace(0, 2 * np.pi, 100_000), [2, 5])) @ [0.25, 1.0]
DEEPEST = CONFIG.casings["2nd5nd"].amplitude * (1 - WAVES.min() / WAVES.max()) + CLEARANCE
NO_HISTORY = {"analysis.histories": []}
TWO_SPEEDS = NO_HISTORY | {"speeds": {"start": 0.29, "stop": 0.3, "step": 0.01, "extra": []}}
COARSE = {"contact.elements": 100, "analysis.max_order": 50}
SAMPLES = {"contact.elements": 100_000}
THOUSAND = {"casing": "2nd", "E": [*range(1, 1001)], "K": [1, 2, 3, 4, 5], "theta": [0.0]}
MANY = NO_HISTORY | {
    "coatings": [THOUSAND],
    "speeds": {"start": 0.001, "stop": 0.4, "step": 0.001, "extra": []},
}
RUN = {"casing": "2nd", "E": 2.0, "K": 0.5, "theta": 0.0, "f_omega": 0.197}
TWO_HISTORIES = {"analysis.histories": [RUN, {**RUN}]}
DAMPED = {"contact.damping_ratio": 0.01}
EVEN = {"blades": 36, "angle_error": [0.0] * 36}
SLOW = NO_HISTORY | {"speeds": {"start": 0.02, "stop": 0.25, "step": 0.01, "extra": []}}
TWICE = {"contact.scale": {"length": 2, "modulus": 1, "time": 1}}
BORDERS = [
    # what else is changed, the key, a value that is allowed, one that is not
    ({"reduction.modes_per_speed": 5}, "reduction.accuracy_modes", 29, 30),
    ({"contact.layer_thickness": 0.01}, "casings.2nd.interference", 2e-3 + CLEARANCE, 2.00001e-3 + CLEARANCE),
    ({"contact.layer_thickness": 6e-4}, "casings.2nd.interference", math.nextafter(6e-4, 0), 6e-4),
    ({}, "casings.2nd.interference", just_above(CLEARANCE), CLEARANCE),
    (TWICE, "casings.2nd.interference", just_above(CLEARANCE / 2), CLEARANCE / 2),
    ({}, "coatings[0].interference", [CLEARANCE * (1 + 1e-9)], [CLEARANCE * (1 - 1e-9)]),
    ({}, "coatings[0].interference", [DEEPEST * (1 - 1e-5)], [4e-4, DEEPEST * (1 + 1e-5)]),
    ({}, "coatings[0].layer_thickness", [5.00001e-4], [4e-3, 5e-4]),
    ({"coatings[0].layer_thickness": [6e-4]}, "coatings[0].interference", [5.99999e-4], [6e-4]),
    (COARSE, "contact.tip_profile.half_width", 12.5, just_above(12.5)),
    ({}, "contact.tip_profile.half_width", 20, just_above(20)),
    (COARSE, "casings.2nd.nodal_diameters[0]", 50, 51),
    ({}, "casings.2nd.weights", [-1e-9], [0]),
    ({}, "casings.2nd5nd.interference", DEEPEST * (1 - 1e-5), DEEPEST * (1 + 1e-5)),
    (TWO_SPEEDS, "speeds.stop", 0.3, 0.299),
    ({}, "speeds.extra", [0.19, 0.197, 0.4], [0.19, 0.197, just_above(0.4)]),
    (MANY, "speeds.extra", [], [0.0015]),
    (MANY | {"speeds.step": 0.01}, "coatings[0].K", [1, 2, 3, 4, 5], THOUSAND["E"]),
    (TWO_HISTORIES, "analysis.histories[1]", RUN, RUN | {"E": 2.5}),
    (TWO_HISTORIES, "analysis.histories[1].f_omega", 0.197, 0.1971),
    (TWO_HISTORIES, "analysis.histories[1].casing", "2nd", "3nd"),
    (DAMPED | {"rotor": EVEN}, "rotor.angle_error[35]", 0.0, -0.17),
    (DAMPED | {"rotor": {"blades": 36}}, "rotor.blades", 36, 200),
    (SLOW, "analysis.peaks.orders", [4], [3]),
    (SLOW, "casings.2nd.peak_orders", [4], [3]),
    ({}, "analysis.peaks.orders", [4, 60], [4, 61]),
    ({}, "analysis.spectrum_revolutions", 20, 21),
    ({}, "analysis.divergence.confirmation_revolutions", 30, 29),
    (SAMPLES, "analysis.divergence.confirmation_revolutions", 200, 201),
    (SAMPLES | {"analysis.divergence.confirmation_revolutions": 0}, "solver.revolutions", 200, 201),
    ({"sweeps.start": 0.3}, "sweeps.stop", just_above(0.3), 0.3),
    ({}, "chart.K", [1, 1.00001], [1, 1.0000001]),
    ({"blade.mesh": {"chordwise": 50, "thickness": 10, "spanwise": 2}}, "blade.mesh.spanwise", 40, 41),
    ({"blade.mesh": {"chordwise": 9, "thickness": 1, "spanwise": 2}}, "blade.mesh.chordwise", 7, 6),
    *(({}, "results", "own", name) for name in ("..", "/tmp", "", "$(touch x)", "src", "README.md/runs")),
]
SUMS = ("speeds", "blade.mesh:", "coatings[0]:", "rotor.blades = 36:")
"""What is named where several keys together are too much."""


@pytest.mark.extras(cases=r"others4-|rotor|sweeps|chart")
@pytest.mark.parametrize(("others", "key", "inside", "outside"), BORDERS)
def test_parts_of_a_config_agree_up_to_the_border_and_not_beyond(
    config, problems, others, key, inside, outside
):
    for path, value in others.items():
        change(config, path, value)
    change(config, key, inside)
    assert problems(config) == []
    change(config, key, outside)
    (problem,) = problems(config)
    assert problem.text.startswith((key, *SUMS))


@pytest.mark.extras
def test_matrices_fix_the_number_of_fit_speeds(config, problems, tmp_path):
    for name in ("mass.mtx", "stiffness_rest.mtx", "stiffness_half.mtx", "stiffness_max.mtx", "nodes.csv"):
        (tmp_path / name).touch()
    config["blade"]["source"] = {"matrices": str(tmp_path)}
    config["reduction"]["fit_speeds"] = 3
    assert problems(config) == []
    config["reduction"]["fit_speeds"] = 4
    (problem,) = problems(config)
    assert problem.text.startswith("reduction.fit_speeds = 4: ")
    config["blade"].pop("source")
    assert problems(config) == []


STUDY = load(ROOT / "config" / "config.yaml")


def all_keys(key, path="", is_said=True):
    yield path, key, is_said
    for name, inner in key.fields().items():
        yield from all_keys(inner, f"{path}.{name}" if path else name, bool(inner.description))
    if key.entry:
        yield from all_keys(key.entry, f"{path}[]")


KEYS = list(all_keys(key_of(whole())))
BY_PATH = {path: key for path, key, _ in KEYS}


def test_every_number_has_bounds_and_every_key_of_a_group_says_what_it_is():
    for path, key, is_said in KEYS:
        assert is_said, path
        assert key.kind not in NUMBERS or None not in key.ends, path


def test_what_limits_a_number_is_a_number_or_a_group_of_the_config():
    limits = [limit for key in BY_PATH.values() for limit in key.limits]
    assert limits
    for limit in limits:
        value = STUDY
        for name in limit.key.split("."):
            value = value[name]
        assert isinstance(value, int | float), limit
    assert {key.one_of for key in BY_PATH.values() if key.one_of} <= STUDY.keys()


class Profile(Section):
    """A source of blades."""

    digits: str


@pytest.mark.parametrize("others", [{}, {"blade.source": Profile}])
def test_a_key_plugs_in_below_a_section_that_plugs_in_or_is_not_there(monkeypatch, others):
    monkeypatch.setattr(plugins, "loaded", lambda kind: {"blade.source.profile": Profile} | others)
    source = key_of(whole.__wrapped__()).fields()["blade"].fields()["source"]
    assert source.fields().keys() == {"profile", *(["digits"] if others else [])}
    assert source.fields()["profile"].fields().keys() == {"digits"}


@pytest.mark.parametrize("value", [True, None, "0.2", [0.2], float("nan"), float("-inf"), 10**400])
def test_only_finite_numbers_are_numbers(value):
    class Mine(Section):
        """A section."""

        length: float

    assert list(problems({"length": 2}, Mine)) == []
    (line,) = problems({"length": value}, Mine)
    assert line.startswith("length = ")


def test_defaults_are_of_keys_that_may_be_left_out():
    assert defaults().keys() <= STUDY.keys()
    assert not defaults().keys() & required()


@pytest.mark.extras
def test_settings_of_extras_are_named_by_their_plugins():
    """A `settings.py` that nothing names would check nothing."""
    settings = {path.parent.name for path in (PACKAGE / "extras").glob("*/settings.py")}
    plugged = (PACKAGE / "extras").glob("*/plugin.py")
    named = {path.parent.name for path in plugged if ".settings:" in path.read_text()}
    assert settings == named
