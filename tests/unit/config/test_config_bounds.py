"""Every bound of a config, written down a second time: values at it, just inside and just outside."""

import copy
import math
import re

import numpy as np
import pytest

from bladerub.config import schema as config_schema
from bladerub.config.errors import ConfigError, key_path
from bladerub.config.read import load, validate
from bladerub.io.folders import ROOT

NUMBERS = """
    blade.source.omega_max            (0, 1e5]
    blade.source.tip_cone             [-45, 45]
    blade.material.young_modulus      [1e8, 1e12]
    blade.material.poisson_ratio      [0, 0.49]
    blade.material.density            [500, 25000]
    blade.hub_radius                  [0.01, 5]
    blade.length                      [0.01, 3]
    blade.tip_cone                    [-45, 45]
    blade.sections.span               [0, 1]
    blade.sections.chord              [0.001, 2]
    blade.sections.thickness          [0.005, 0.4]
    blade.sections.camber             [-120, 120]
    blade.sections.stagger            [-85, 85]
    blade.sections.sweep              [-1, 1]
    blade.sections.lean               [-1, 1]
    blade.mesh.chordwise              [4, 200]
    blade.mesh.thickness              [1, 20]
    blade.mesh.spanwise               [2, 400]
    reduction.f_omega_max             [0.01, 2]
    reduction.modes_per_speed         [1, 50]
    reduction.fit_speeds              [3, 7]
    reduction.tolerance               [1e-5, 0.5]
    reduction.interface_nodes         [4, 32]
    reduction.rank_tolerance          [1e-12, 0.1]
    reduction.accuracy_speeds         [2, 200]
    reduction.accuracy_modes          [1, 50]
    contact.modulus_unit              [1e3, 1e12]
    contact.yield_stress              [0, 100]
    contact.law                       [-1e15, 1e15]
    layer_thickness                   [1e-4, 0.1]
    contact.elements                  [100, 100000]
    contact.tip_profile.half_width    (0, 20]
    contact.tip_profile.edge_drop     [0, 0.01]
    contact.clearance.leading_edge    [0, 0.05]
    contact.clearance.trailing_edge   [0, 0.05]
    contact.scale.length              [0.001, 1000]
    contact.scale.modulus             [1e-6, 1e6]
    contact.scale.time                [0.001, 1000]
    damping_ratio                     [0, 1)
    casings.nodal_diameters           [1, 100]
    casings.weights                   [-100, 100]
    casings.amplitude                 (0, 0.05]
    casing_interference               (0, 0.05]
    casings.bump_width                (0, 1]
    start_angle                       [-360, 360]
    E                                 (0, 1e6]
    K                                 [0, 1e6]
    theta                             [0, 1.5]
    friction                          [0, 1]
    f_omega                           [0.001, 2]
    order                             [1, 1000]
    interference                      (0, 0.05]
    rotor.blades                      [1, 200]
    rotor.length                      [-0.01, 0.01]
    rotor.frequency                   [-0.5, 0.5]
    rotor.damping                     [0, 100]
    rotor.angle_error                 [-0.5, 0.5]
    rotor.coupling                    [0, 10]
    rotor.length_scatter              [0, 0.01]
    rotor.frequency_scatter           [0, 0.1]
    rotor.seed                        [0, 4294967295]
    speeds.start                      [0.001, 2]
    speeds.stop                       [0.001, 2]
    speeds.step                       [1e-4, 2]
    solver.revolutions                [1, 10000]
    solver.tolerance                  [1e-5, 0.1]
    solver.steps_per_element          [1, 1000]
    solver.max_time_step              [1e-9, 1e-4]
    solver.displacement_limit         [0.001, 1]
    analysis.spectrum_revolutions     [1, 10000]
    analysis.max_order                [1, 10000]
    analysis.peaks.order_halfwidth    (0, 0.5]
    analysis.peaks.speed_window       (0, 5]
    analysis.divergence.revolutions   [3, 10000]
    analysis.divergence.growth        [0, 10]
    analysis.divergence.confidence    [0.5, 0.9999]
    analysis.divergence.confirmation_revolutions   [0, 10000]
    analysis.lobe_prominence          (0, 1)
    chart.K                           (0, 1e6]
    chart.speeds.start                [0.001, 2]
    chart.speeds.step                 [1e-4, 2]
    chart.speeds.dense_stop           [0.001, 2]
    chart.speeds.dense_step           [1e-4, 2]
    chart.speeds.refine_above         (0, 1]
    chart.limits.amplitude            (0, 10]
    chart.limits.wear                 (0, 1]
    chart.limits.divergent_share      [0, 1]
    chart.limits.fatigue              (0, 1e11]
    sweeps.start                      (0, 10]
    sweeps.stop                       (0, 10]
    sweeps.rates                      [1e-4, 10]
    sweeps.speed_step                 [1e-6, 0.1]
    sweeps.survival                   (0, 1]
    ensemble.members                  [0, 1000]
    ensemble.displacement             (0, 1e-5]
    ensemble.seed                     [0, 4294967295]
    long_runs.revolutions             [1, 10000]
    figures.dpi                       [30, 1200]
    figures.max_frequency             (0, 100]
    figures.amplitude_range           (0, 1]
    figures.nominal_speed             (0, 1e6]
"""
NUMBERS = dict(line.split(maxsplit=1) for line in NUMBERS.strip().splitlines())

COUNTS = {
    "blade.sections": (2, 50),
    "casings": (1, 100),
    "casings.nodal_diameters": (1, 20),
    "casings.weights": (1, 20),
    "peak_orders": (1, 1000),
    "coatings": (1, 1000),
    "coatings.E": (1, 1000),
    "coatings.K": (1, 1000),
    "coatings.theta": (1, 1000),
    "coatings.friction": (1, 1000),
    "damping_ratios": (1, 1000),
    "layer_thicknesses": (1, 1000),
    "interferences": (1, 1000),
    "friction": (0, 100),
    "friction.E": (1, 20),
    "friction.K": (1, 20),
    "friction.theta": (1, 20),
    "rotor.length": (1, 200),
    "rotor.frequency": (1, 200),
    "rotor.damping": (1, 200),
    "rotor.angle_error": (1, 200),
    "rotor.coupling": (1, 200),
    "speeds.extra": (0, 10000),
    "analysis.peaks.orders": (1, 1000),
    "analysis.peaks.speed_window": (2, 2),
    "analysis.histories": (0, 10000),
    "chart.theta": (1, 10),
    "chart.E": (2, 200),
    "chart.K": (2, 200),
    "sweeps.coatings": (0, 5000),
    "sweeps.rates": (1, 100),
    "figures.amplitude_range": (2, 2),
}

STUDY = load(ROOT / "config" / "config.yaml")
MODULI = {"casing": "2nd", "E": 2.0, "K": 0.5}
KINDS = [MODULI | {"theta": 0.0}, MODULI | {"friction": 0.1}]
KINDS += [{"casing": "2nd", "coating": "rigid", "friction": 0.1}]


@pytest.fixture
def config():
    return copy.deepcopy(STUDY)


@pytest.fixture
def complete(config):
    """The study with every group and every kind of entry that a config may have."""
    own = {"damping_ratio": 0.001, "interference": 4e-4, "layer_thickness": 4e-3}
    rigid = {"damping_ratio": 0.001, "interference": 4e-4}
    kinds = [kind | (rigid if "coating" in kind else own) for kind in KINDS]
    listed = [{key: [v] if isinstance(v, float) else v for key, v in kind.items()} for kind in kinds]
    config["blade"]["source"] = {}
    config["contact"]["scale"] = {"length": 1, "modulus": 1, "time": 1}
    config["contact"]["law"] = {"name": "plastic"}
    config["casings"]["2nd"] |= {"peak_orders": [4], "bump_width": 0.5}
    config["casings"]["table"] = {"table": {"file": "gap.csv"}, "start_angle": 0.0, "peak_orders": [4]}
    config["coatings"], config["friction"] = (
        listed,
        [{key: listed[0][key] for key in ("casing", "E", "K", "theta")}],
    )
    config["rotor"] = {"blades": 1, "seed": 1, "length_scatter": 0.0, "frequency_scatter": 0.0}
    lists = ("length", "frequency", "damping", "angle_error", "coupling")
    config["rotor"] |= {key: [0.0] for key in lists}
    config["analysis"]["histories"] = [kind | {"f_omega": 0.19} for kind in kinds]
    return config


def entries(rule, keys=()):
    """Yield each entry of the schema: its keys in `complete`, its name in the tables, itself."""
    name = ".".join(key for key in keys if isinstance(key, str) and key not in ("2nd", "table"))
    if "$ref" in rule:
        name = rule["$ref"].rsplit("/", 1)[1]
        rule = config_schema.schema()["$defs"][name]
    yield keys, name, rule
    for key, inner in rule.get("properties", {}).items():
        yield from entries(inner, (*keys, key))
    if isinstance(rule.get("additionalProperties"), dict):
        for casing, kind in zip(("2nd", "table"), kinds(rule["additionalProperties"]), strict=False):
            yield from entries(kind, (*keys, casing))
    for index, kind in enumerate(kinds(rule.get("items", {}))):
        yield from entries(kind, (*keys, index))


def kinds(rule):
    """The kinds of entry that a list or group may have."""
    conditional = [kind["then"] for kind in rule.get("allOf", []) if "then" in kind]
    return conditional or ([rule] if rule else [])


ENTRIES = list(entries(config_schema.schema()))
NUMERIC = [
    pytest.param(*entry, id=key_path(entry[0]))
    for entry in ENTRIES
    if entry[2].get("type") in ("number", "integer")
]


def test_every_number_of_the_schema_is_in_the_table():
    assert {name for _, name, rule in ENTRIES if rule.get("type") in ("number", "integer")} == NUMBERS.keys()


def test_every_list_and_group_of_names_has_its_length_in_the_table():
    lengths = {
        name: (
            rule.get("minItems", rule.get("minProperties", 0)),
            rule.get("maxItems", rule.get("maxProperties")),
        )
        for _, name, rule in ENTRIES
        if rule["type"] == "array" or "minProperties" in rule
    }
    assert lengths == COUNTS


def just_above(value):
    return math.nextafter(value, math.inf)


def change(config, keys, value):
    *parents, key = keys
    for parent in parents:
        config = config[parent]
    config[key] = value


def is_out_of_range(config, keys):
    """Whether the value is refused for itself, not as compared with another key."""
    found = [text for text in config_schema.problems(config) if text.startswith(f"{key_path(keys)} = ")]
    return any(": must be" not in text for text in found)


@pytest.mark.parametrize(("keys", "name", "rule"), NUMERIC)
def test_a_number_is_allowed_up_to_its_bounds_and_not_beyond(complete, keys, name, rule):
    left, low, high, right = re.fullmatch(r"([\[(])(.+), (.+)([\])])", NUMBERS[name]).groups()
    for end, is_closed, inward in (
        (float(low), left == "[", math.inf),
        (float(high), right == "]", -math.inf),
    ):
        if rule["type"] == "integer":
            step = math.copysign(1, inward)
            outside, at, inside = int(end - step), int(end), int(end + step)
        else:
            outside, at, inside = math.nextafter(end, -inward), end, math.nextafter(end, inward)
        for value, allowed in ((outside, False), (at, is_closed), (inside, True)):
            change(complete, keys, value)
            assert is_out_of_range(complete, keys) != allowed, value


@pytest.mark.parametrize(
    ("keys", "inside", "outside"),
    [
        (("seed",), (0, 2**32 - 1), (-1, 2**32)),
        (("factors", "unit", "multiple_of"), (5e-324, 1e12), (0, just_above(1e12))),
        (("factors", "unit", "sets", "contact.modulus_unit", 0), (-1e12,), (-just_above(1e12),)),
        (("factors", "unit", "sets", "contact.modulus_unit", 1), (1e12,), (just_above(1e12),)),
        (("parts", "lobes", "samples"), (2, 64, 4096), (0, 1, 3, 100, 8192)),
    ],
)
def test_the_numbers_of_a_plan_are_allowed_up_to_their_bounds_and_not_beyond(keys, inside, outside):
    factor = {"unit": "Pa", "multiple_of": 1, "sets": {"contact.modulus_unit": [1, 2]}}
    part = {"claims": ["C2"], "samples": 2, "study": {}}
    plan = {"seed": 1, "factors": {"unit": factor}, "parts": {"lobes": part}}
    for value in (*inside, *outside):
        change(plan, keys, value)
        found = list(config_schema.problems(plan, "robustness_plan"))
        assert bool(found) == (value in outside)
        assert all(problem.startswith(f"{key_path(keys)} = ") for problem in found)


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
BORDERS = [
    # what else is changed, the key, a value that is allowed, one that is not
    ({}, "reduction.accuracy_modes", 30, 31),
    ({"reduction.modes_per_speed": 5}, "reduction.accuracy_modes", 29, 30),
    (
        {"contact.layer_thickness": 0.01},
        "casings.2nd.interference",
        0.002 + CLEARANCE,
        0.00200001 + CLEARANCE,
    ),
    ({"contact.layer_thickness": 6e-4}, "casings.2nd.interference", math.nextafter(6e-4, 0), 6e-4),
    ({}, "casings.2nd.interference", just_above(CLEARANCE), CLEARANCE),
    (
        {"contact.scale": {"length": 2, "modulus": 1, "time": 1}},
        "casings.2nd.interference",
        just_above(CLEARANCE / 2),
        CLEARANCE / 2,
    ),
    ({}, "coatings[0].interference", [CLEARANCE * (1 + 1e-9)], [CLEARANCE * (1 - 1e-9)]),
    ({}, "coatings[0].interference", [DEEPEST * (1 - 1e-5)], [4e-4, DEEPEST * (1 + 1e-5)]),
    ({}, "coatings[0].layer_thickness", [5.00001e-4], [4e-3, 5e-4]),
    ({"coatings.0.layer_thickness": [6e-4]}, "coatings[0].interference", [5.99999e-4], [6e-4]),
    (COARSE, "contact.tip_profile.half_width", 12.5, just_above(12.5)),
    ({}, "contact.tip_profile.half_width", 20, just_above(20)),
    (COARSE, "casings.2nd.nodal_diameters[0]", 50, 51),
    ({}, "casings.2nd.weights", [1], [1, 1]),
    ({}, "casings.2nd.weights", [-1e-9], [0]),
    ({}, "casings.2nd5nd.weights", [0, 1], [0, 0]),
    ({}, "casings.2nd5nd.interference", DEEPEST * (1 - 1e-5), DEEPEST * (1 + 1e-5)),
    (TWO_SPEEDS, "speeds.stop", 0.3, 0.289),
    (TWO_SPEEDS, "speeds.stop", 0.3, 0.299),
    ({}, "speeds.stop", 0.4, just_above(0.4)),
    ({}, "speeds.extra", [0.19, 0.197, 0.4], [0.19, 0.197, just_above(0.4)]),
    (MANY, "speeds.extra", [], [0.0015]),
    (SLOW, "analysis.peaks.orders", [4], [3]),
    (SLOW, "casings.2nd.peak_orders", [4], [3]),
    ({}, "analysis.peaks.orders", [4, 60], [4, 61]),
    ({}, "analysis.peaks.speed_window", [1, 1.0001], [1, 1]),
    ({}, "analysis.max_order", 1000, just_above(1000)),
    ({}, "analysis.spectrum_revolutions", 20, 21),
    ({}, "analysis.divergence.revolutions", 20, 21),
    ({}, "analysis.divergence.confirmation_revolutions", 30, 29),
    ({}, "analysis.divergence.confirmation_revolutions", 0, 1),
    (SAMPLES, "analysis.divergence.confirmation_revolutions", 200, 201),
    (SAMPLES | {"analysis.divergence.confirmation_revolutions": 0}, "solver.revolutions", 200, 201),
    ({}, "sweeps.stop", 0.4, just_above(0.4)),
    ({"sweeps.start": 0.3}, "sweeps.stop", just_above(0.3), 0.3),
    ({}, "chart.speeds.start", math.nextafter(0.4, 0), 0.4),
    ({}, "chart.K", [1, 1.00001], [1, 1.0000001]),
    ({}, "chart.theta", [0.0, 0.15], [0.15, 0.0]),
    ({}, "chart.casing", "2nd5nd", "3nd"),
    ({}, "figures.amplitude_range", [1e-5, 2e-5], [2e-5, 2e-5]),
]


@pytest.mark.parametrize(("others", "key", "inside", "outside"), BORDERS)
def test_parts_of_a_config_agree_up_to_the_border_and_not_beyond(config, others, key, inside, outside):
    keys = [name or int(index) for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", key)]
    for path, value in others.items():
        change(config, [int(key) if key.isdigit() else key for key in path.split(".")], value)
    change(config, keys, inside)
    assert problems(config) == []
    change(config, keys, outside)
    (problem,) = problems(config)
    assert problem.startswith((key, "speeds"))


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


@pytest.mark.parametrize(
    ("mesh", "is_allowed"),
    [((50, 10, 40), True), ((50, 10, 41), False), ((7, 1, 2), True), ((6, 1, 2), False)],
)
def test_the_mesh_has_as_many_elements_as_fit_the_memory_and_eight_nodes_at_the_tip(config, mesh, is_allowed):
    config["blade"]["mesh"] = dict(zip(("chordwise", "thickness", "spanwise"), mesh, strict=True))
    assert [problem.startswith("blade.mesh") for problem in problems(config)] == [True] * (not is_allowed)


def test_order_is_asked_of_numbers_alone(config):
    config["analysis"]["peaks"]["speed_window"] = [1.35, "0.85"]
    (problem,) = problems(config)
    assert problem.startswith('analysis.peaks.speed_window[1] = "0.85": ')


def test_every_comparison_of_the_schema_names_a_number_or_a_group_of_the_config():
    limits = [limit for *_, rule in ENTRIES for limit in rule.get("limits", [])]
    assert limits
    for limit in limits:
        value = STUDY
        for key in config_schema._LIMIT.fullmatch(limit)[2].split("."):
            value = value[key]
        assert config_schema.is_number(value), limit
    assert {rule["keyOf"] for *_, rule in ENTRIES if "keyOf" in rule} == {"casings"} <= STUDY.keys()


@pytest.mark.parametrize("value", ["fast", None, [0.4], True, math.inf])
def test_what_is_no_number_is_not_compared(config, value):
    config["speeds"]["stop"] = value
    (problem,) = problems(config)
    assert problem.startswith("speeds.stop = ")
