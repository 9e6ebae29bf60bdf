"""What limits a value by other keys: values at the border, just inside and just outside."""

import copy
import math
import re

import numpy as np
import pytest

from bladerub.config.errors import ConfigError
from bladerub.config.read import load, validate
from bladerub.io.folders import ROOT

STUDY = load(ROOT / "config" / "config.yaml")
MODULI = {"casing": "2nd", "E": 2.0, "K": 0.5}


@pytest.fixture
def config():
    return copy.deepcopy(STUDY)


def just_above(value):
    return math.nextafter(value, math.inf)


def change(config, path, value):
    *parents, key = [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", path)]
    for parent in parents:
        config = config[parent]
    config[key] = value


def problems(config):
    try:
        validate(config)
    except ConfigError as error:
        return [problem.text for problem in error.problems]
    return []


CLEARANCE = min(STUDY["contact"]["clearance"].values()) * STUDY["blade"]["length"]
WAVES = np.cos(np.outer(np.linspace(0, 2 * np.pi, 100_000), [2, 5])) @ [0.25, 1.0]
DEEPEST = STUDY["casings"]["2nd5nd"]["amplitude"] * (1 - WAVES.min() / WAVES.max()) + CLEARANCE
TWO_SPEEDS = {"analysis.histories": [], "speeds": {"start": 0.29, "stop": 0.3, "step": 0.01, "extra": []}}
COARSE = {"contact.elements": 100, "analysis.max_order": 50}
SAMPLES = {"contact.elements": 100_000}
MANY = {
    "analysis.histories": [],
    "coatings": [{"casing": "2nd", "E": [1 + i for i in range(1000)], "K": [1, 2, 3, 4, 5], "theta": [0.0]}],
    "speeds": {"start": 0.001, "stop": 0.4, "step": 0.001, "extra": []},
}
SLOW = {"analysis.histories": [], "speeds": {"start": 0.02, "stop": 0.25, "step": 0.01, "extra": []}}
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
]


@pytest.mark.parametrize(("others", "key", "inside", "outside"), BORDERS)
def test_parts_of_a_config_agree_up_to_the_border_and_not_beyond(config, others, key, inside, outside):
    for path, value in others.items():
        change(config, path, value)
    change(config, key, inside)
    assert problems(config) == []
    change(config, key, outside)
    (problem,) = problems(config)
    assert problem.startswith((key, "speeds", "blade.mesh:"))


def test_matrices_fix_the_number_of_fit_speeds(config, tmp_path):
    for name in ("mass.mtx", "stiffness_rest.mtx", "stiffness_half.mtx", "stiffness_max.mtx", "nodes.csv"):
        (tmp_path / name).touch()
    config["blade"]["source"] = {"matrices": str(tmp_path)}
    config["reduction"]["fit_speeds"] = 3
    assert problems(config) == []
    config["reduction"]["fit_speeds"] = 4
    (problem,) = problems(config)
    assert problem.startswith("reduction.fit_speeds = 4: ")
    config["blade"].pop("source")
    assert problems(config) == []


@pytest.mark.parametrize(
    ("entry", "key"),
    [
        ({"E": 2.5}, "analysis.histories[1] = 2nd_E2.5_K0.5_theta0"),
        ({"f_omega": 0.1971}, "analysis.histories[1].f_omega = 0.1971"),
        ({"casing": "3nd"}, "analysis.histories[1].casing"),
    ],
)
def test_a_history_is_of_a_run_of_the_study(config, entry, key):
    run = MODULI | {"theta": 0.0, "f_omega": 0.197}
    config["analysis"]["histories"] = [run, run]
    assert problems(config) == []
    config["analysis"]["histories"] = [run, run | entry]
    (problem,) = problems(config)
    assert problem.startswith(key)


@pytest.mark.parametrize("value", ["fast", None, [0.4], True, math.inf])
def test_what_is_no_number_is_not_compared(config, value):
    config["speeds"]["stop"] = value
    (problem,) = problems(config)
    assert problem.startswith("speeds.stop = ")
