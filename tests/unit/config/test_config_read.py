import copy
from unittest.mock import Mock

import jsonschema
import numpy as np
import pytest

from bladerub.config import schema as schema_module
from bladerub.config.errors import ConfigError
from bladerub.config.read import load, validate
from bladerub.config.schema import check_quantity, schema
from bladerub.contact import laws
from bladerub.contact.spec import ElementLaw
from bladerub.io.folders import ROOT

CONFIGS = [
    [ROOT / "config" / "config.yaml"],
    [ROOT / "config" / "config.yaml", ROOT / "config" / "quick.yaml"],
    [ROOT / "config" / "config.yaml", ROOT / "config" / "twisted_plate.yaml"],
]


@pytest.fixture(scope="module")
def paper():
    return load(*CONFIGS[0])


@pytest.fixture
def config(paper):
    return copy.deepcopy(paper)


def problems(config):
    with pytest.raises(ConfigError) as error:
        validate(config)
    return [problem.text for problem in error.value.problems]


def rules(rule, path=""):
    """Every entry of the schema, with its path."""
    if "allOf" in rule:  # kinds of entry, distinguished by their keys
        for number, kind in enumerate(rule["allOf"]):
            if "then" in kind:
                yield from rules(kind["then"], f"{path}[{number}]")
        return
    yield path, rule
    for key in ("properties", "$defs"):
        for name, inner in rule.get(key, {}).items():
            if "$ref" not in inner:
                yield from rules(inner, f"{path}.{name}")
    for key in ("items", "additionalProperties", "propertyNames"):
        if isinstance(rule.get(key), dict) and "$ref" not in rule[key]:
            yield from rules(rule[key], f"{path}[{key}]")


@pytest.mark.parametrize("paths", CONFIGS, ids=["config", "quick", "plate"])
def test_configs_of_the_repository_are_valid(paths):
    config = load(*paths)
    assert validate(config) == config


def test_schema_is_a_schema():
    jsonschema.Draft202012Validator.check_schema(schema())


@pytest.mark.parametrize(("path", "rule"), [pytest.param(p, r, id=p or "top") for p, r in rules(schema())])
def test_every_entry_of_the_schema_says_what_it_is(path, rule):
    assert {"title", "type", "unit", "description"} <= rule.keys()
    if rule["type"] in ("number", "integer"):
        assert rule.keys() & {"minimum", "exclusiveMinimum"}
        assert rule.keys() & {"maximum", "exclusiveMaximum"}
        assert rule["unit"] != "none"
    if rule["type"] == "string":
        assert {"pattern", "form"} <= rule.keys()
    if rule["type"] == "object" and path:
        assert "additionalProperties" in rule


def test_every_key_of_the_schema_is_needed_but_extend_and_what_another_blade_brings():
    optional = {
        "extend",
        "source",
        "scale",
        "fit_speeds",
        "tolerance",
        "interface_nodes",
        "friction",
        "common",
        "multiple_of",
    }
    optional |= {"peak_orders", "damping_ratio", "layer_thickness", "interference", "tip_turns"}
    optional |= {"interface_nodes", "bump_width", "unit", "angle_unit", "sweeps", "patterns"}
    optional |= {"rotor", "length", "frequency", "damping", "angle_error", "coupling"}
    optional |= {"length_scatter", "frequency_scatter", "seed", "law", "name", "file", "nominal_speed"}
    optional |= {"fatigue", "measured", "steps_per_element", "max_time_step"}
    for path, rule in rules(schema()):
        if "properties" in rule and not path.startswith(".blade.source"):
            known, required = set(rule["properties"]), set(rule["required"])
            assert known - optional <= required <= known, path


@pytest.mark.parametrize(
    ("law", "message"),
    [
        ({"name": "viscoplastic"}, "contact.law.viscosity: missing, stress beyond the elastic limit"),
        ({"name": "viscoplastic", "viscosity": -1}, "contact.law.viscosity = -1: stress beyond"),
        ({"name": "viscoplastic", "viscosity": "high"}, 'contact.law.viscosity = "high": parameter'),
        ({"name": "elastic"}, "contact.law.name = elastic: must be one of plastic, brittle"),
        ({"viscosity": 1.0}, "contact.law.viscosity = 1.0: unknown parameter, this law has no parameters"),
        ({"file": "none.py"}, "contact.law.file = none.py: there is no such file"),
        ({"name": "plastic", "file": "a.py"}, 'contact.law.file = "a.py": must be without'),
    ],
)
def test_a_wrong_law_is_one_line(config, law, message):
    config["contact"]["law"] = law
    (found,) = problems(config)
    assert found.startswith(message)


def test_every_law_and_its_parameters_are_in_the_schema(config):
    rule = schema()["properties"]["contact"]["properties"]["law"]
    for name in laws.NAMES:
        assert name in rule["properties"]["name"]["form"]
        for parameter, of in laws.parameters_of(laws.source_of(ElementLaw(name))).items():
            assert (
                f"{parameter} ({of.unit})".removesuffix(" (1)") in rule["additionalProperties"]["description"]
            )


def test_overlays_merge_mappings_and_replace_lists(tmp_path):
    base, overlay = tmp_path / "base.yaml", tmp_path / "overlay.yaml"
    base.write_text("a: {b: 1, c: [1, 2]}\nd: 5\n")
    overlay.write_text("a: {c: [3]}\nd: {e: 6}\n")
    assert load(base, overlay) == {"a": {"b": 1, "c": [3]}, "d": {"e": 6}}


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("1e-3", 1e-3),
        ("1.0e3", 1e3),
        ("1.e+3", 1e3),
        (".5E2", 50.0),
        ("-2e1", -20.0),
        ("1_000", 1000),
        ("3", 3),
    ],
)
def test_numbers_of_any_spelling_are_numbers(tmp_path, text, number):
    path = tmp_path / "config.yaml"
    path.write_text(f"value: {text}\nlist: [{text}]\n")
    config = load(path)
    assert config == {"value": number, "list": [number]}
    assert not isinstance(config["value"], str)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"a: [1\nb: 2\n", ":2: not valid YAML"),
        (b"a: 1\n\nb: 2\nb: 3\n", ":4: not valid YAML (b is given twice)"),
        (b"- 1\n", "must hold keys at its top level"),
        (b"", "must hold keys at its top level"),
        (b"\xff\xfe", "is not text in UTF-8"),
        (b"a: !!python/object/apply:os.getcwd []\n", ":1: not valid YAML"),
    ],
)
def test_malformed_file_is_named(tmp_path, content, words):
    path = tmp_path / "config.yaml"
    path.write_bytes(content)
    with pytest.raises(ConfigError) as error:
        load(path)
    (problem,) = map(str, error.value.problems)
    assert problem.startswith(str(path))
    assert words in problem


def test_missing_file_is_named(tmp_path):
    with pytest.raises(ConfigError, match=r"no\.yaml: cannot be read \(No such file or directory\)"):
        load(tmp_path / "no.yaml")


@pytest.mark.parametrize(
    "value", [True, None, "0.2", [0.2], float("nan"), float("-inf"), 10**400], ids=lambda v: str(v)[:5]
)
def test_only_numbers_are_numbers(config, value):
    config["blade"]["length"] = value
    (problem,) = problems(config)
    assert problem.startswith("blade.length = ")


@pytest.mark.parametrize("name", ["..", "a/../b", "/tmp", "", "a b", "a//b", ".hidden", "a/"])
def test_results_stay_below_the_repository(config, name):
    config["results"] = name
    (problem,) = problems(config)
    assert problem.startswith("results = ")


@pytest.mark.parametrize(
    ("path", "value", "sentence"),
    [
        ("blade.length", None, "blade.length: missing, blade length must be a number from 0.01 to 3, in m"),
        (
            "figures.xyz",
            1,
            "figures.xyz = 1: unknown key, known here: dpi, max_frequency, amplitude_range, nominal_speed",
        ),
        ("figures.dpj", 1, "figures.dpj = 1: unknown key, did you mean figures.dpi?"),
        (
            "solver.revolutions",
            20.0,
            "solver.revolutions = 20.0: revolutions of a run must be a whole number from 1 to 10000",
        ),
        (
            "blade.length",
            "200 kg",
            'blade.length = "200 kg": is a mass; must be a length: mm, µm, cm, m, in, ft, or a number in m',
        ),
        (
            "contact.damping_ratio",
            1,
            "contact.damping_ratio = 1: modal damping ratio must be a number of at least 0 and below 1",
        ),
        (
            "reduction.f_omega_max",
            3,
            "reduction.f_omega_max = 3: highest speed of the reduced model must be a number from 0.01 to 2 "
            "(times the first frequency at rest; or rpm, Hz, rad/s)",
        ),
        (
            "analysis.peaks.orders",
            [],
            "analysis.peaks.orders = []: list of engine orders must be a list of 1 to 1000 entries",
        ),
        (
            "chart",
            None,
            "chart: missing, chart of coatings must be a group of keys "
            "(a config of an older version? `bladerub new` writes one that has it)",
        ),
        ("casings", {}, "casings = {}: casings must be a group of keys with 1 to 100 of them"),
        (
            "analysis.peaks.orders",
            [4, 4],
            "analysis.peaks.orders = [4, 4]: list of engine orders must not name one twice",
        ),
        ("chart.K", [1, 5, 2], "chart.K[2] = 2: must be above the one before (5)"),
        ("chart.casing", "3nd", 'chart.casing = "3nd": must be one of the casings, 2nd, 2nd5nd'),
        (
            "speeds.stop",
            0.41,
            "speeds.stop = 0.41: must be at most reduction.f_omega_max = 0.4, the reduced blade is not valid "
            "above",
        ),
        (
            "analysis.max_order",
            1001,
            "analysis.max_order = 1001: must be at most contact.elements / 2 = 1000, there is one sample an "
            "element",
        ),
    ],
)
def test_each_kind_of_problem_has_its_sentence(config, path, value, sentence):
    *groups, key = path.split(".")
    part = config
    for group in groups:
        part = part[group]
    part[key] = value
    if value is None:
        del part[key]
    assert sentence in problems(config)


RIGID = {"casing": "2nd", "coating": "rigid", "friction": [0.0]}
ABRADABLE = {"casing": "2nd", "E": [3], "K": [1], "theta": [0.0]}


@pytest.mark.parametrize(
    ("entry", "start"),
    [
        (RIGID | {"E": [2]}, "coatings[0].E = [2]: unknown key"),
        ({"casing": "2nd", "coating": "rigid"}, "coatings[0].friction: missing"),
        (RIGID | {"friction": [0.1, -0.1]}, "coatings[0].friction[1] = -0.1: "),
        (RIGID | {"friction": 0.1}, "coatings[0].friction = 0.1: "),
        (RIGID | {"casing": "3nd"}, 'coatings[0].casing = "3nd": '),
        (ABRADABLE | {"friction": [0.1]}, "coatings[0].theta = [0.0]: unknown key"),
        ({"casing": "2nd", "E": [3], "friction": [0.1]}, "coatings[0].K: missing"),
        (RIGID | {"coating": "stiff"}, 'coatings[0].coating = "stiff": '),
        (ABRADABLE | {"coating": "stiff"}, 'coatings[0].coating = "stiff": '),
        (ABRADABLE | {"depth": 3}, "coatings[0].depth = 3: unknown key"),
        ("rigid", 'coatings[0] = "rigid": '),
    ],
)
def test_each_kind_of_coating_has_keys_of_its_own(config, entry, start):
    config["coatings"], config["analysis"]["histories"] = [entry], []
    (problem,) = problems(config)
    assert problem.startswith(start)


def test_histories_name_the_rigid_casing_as_the_coatings_do(config):
    history = {"casing": "2nd", "coating": "rigid", "friction": 0.0, "f_omega": 0.19}
    config["analysis"]["histories"] = [history]
    validate(config)
    for change, start in (
        ({"friction": 0.15}, "analysis.histories[0] = 2nd_rigid_mu0.15: must be one of the coatings"),
        ({"E": 2}, "analysis.histories[0].E = 2: unknown key"),
        ({"coating": "stiff"}, 'analysis.histories[0].coating = "stiff": '),
    ):
        config["analysis"]["histories"] = [history | change]
        (problem,) = problems(config)
        assert problem.startswith(start)


@pytest.mark.parametrize(
    "name", ["src", "docs/images", "Config", "tests/results", "README.md", "LICENSE/runs"]
)
def test_results_do_not_go_into_the_repository_itself(config, name):
    config["results"] = name
    (problem,) = problems(config)
    assert problem.startswith(f'results = "{name}": must ')


def test_no_newline_gets_into_a_name(config):
    config["results"] = "results\n"
    config["casings"]["2nd\n"] = config["casings"]["2nd"]
    assert [problem.split(":")[0] for problem in problems(config)] == [
        'casings["2nd "]',
        'results = "results "',
    ]


def test_a_plan_that_nobody_can_compute_is_refused_before_it_is_made(config):
    config["analysis"]["histories"] = []
    thousand = [index + 1 for index in range(1000)]
    config["coatings"] = [{"casing": "2nd", "E": thousand, "K": thousand, "theta": [0.0]}]
    (problem,) = problems(config)
    assert problem.startswith("coatings[0]: ")


def test_the_densest_chart_is_allowed(config):
    grid = [0.05 * 1.3**index for index in range(24)]
    dense = {"E": grid, "K": grid, "theta": [0.0]}
    config["coatings"] += [{"casing": "2nd5nd"} | dense]
    config["coatings"][1] |= dense
    config["speeds"]["step"] = 0.001
    config["solver"]["revolutions"] = 500
    config["analysis"]["divergence"]["confirmation_revolutions"] = 1500
    config["analysis"]["histories"] = []
    config["coatings"] = [entry for entry in config["coatings"] if entry.get("E") == grid]
    validate(config)


def test_the_mesh_counts_for_sections_and_not_for_a_mesh(config, tmp_path):
    for name in ("blade.csv", "blade.msh"):
        (tmp_path / name).write_text("anything")
    config["blade"]["mesh"] = {"chordwise": 4, "thickness": 1, "spanwise": 2}
    config["blade"]["source"] = {"file": str(tmp_path / "blade.msh"), "root_set": "ROOT"}
    validate(config)
    config["blade"]["source"] = {"file": str(tmp_path / "blade.csv")}
    (problem,) = problems(config)
    assert problem.startswith("blade.mesh.chordwise = 4: ")
    config["blade"]["mesh"] = {"chordwise": 200, "thickness": 20, "spanwise": 400}
    assert [problem.split(":")[0] for problem in problems(config)] == ["blade.mesh"]
    config["blade"]["source"]["root_set"] = "ROOT"
    assert [problem.split(":")[0] for problem in problems(config)] == ["blade.source.root_set = ROOT"]


def test_of_thousands_of_problems_forty_are_reported(config):
    config["speeds"]["extra"] = [-1] * 9000
    with pytest.raises(ConfigError) as error:
        validate(config)
    assert len(str(error.value).splitlines()) == 41
    assert str(error.value).endswith("config: and 8960 problems more")


def test_one_broken_part_does_not_hide_the_problems_of_another(config):
    config["blade"]["length"] = "long"
    config["casings"]["2nd"]["weights"] = [0]
    assert len(problems(config)) == 2


def test_quantities_are_checked_as_in_the_config():
    check_quantity("E", 0.11)
    with pytest.raises(ValueError, match="Young modulus must be a number above 0"):
        check_quantity("E", 0)
    with pytest.raises(ValueError, match="Young modulus"):
        check_quantity("E", float("nan"))


def test_the_schema_is_what_the_reader_of_configs_would_make_of_it():
    assert load(schema_module.SCHEMA) == schema()


def test_schema_is_beside_the_package():
    assert schema_module.SCHEMA.is_file()


@pytest.mark.parametrize(
    ("rotor", "said"),
    [
        ({"blades": 200}, "rotor.blades = 200: "),
        ({"blades": 2, "damping": [1, 100]}, "rotor.damping = "),
        ({"blades": 36, "angle_error": [0.0] * 35 + [-0.17]}, "rotor.blades = 36: "),
    ],
)
def test_rows_that_no_run_can_compute_are_refused(config, rotor, said):
    config["rotor"], config["contact"]["damping_ratio"] = rotor, 0.01
    with pytest.raises(ConfigError) as error:
        validate(config)
    assert error.value.problems[0].text.startswith(said)


def test_a_row_as_dense_as_the_runs_allow_is_accepted(config):
    config["rotor"] = {"blades": 36, "damping": [1.0]}
    validate(config)


def test_central_differences_are_checked_by_the_blade_that_is_built(config, monkeypatch):
    """Its highest mode in coordinates of 1 kg has 1e6 rad/s."""
    n, f1 = 30, 2 * np.pi * 480.0
    stiffness = np.diag(np.linspace(f1, 1e6, n) ** 2)
    blade = Mock(f1_hz=480.0, mass=np.eye(n), stiffness=lambda f_omega: stiffness)
    monkeypatch.setattr("bladerub.study.inventory.current_blade", lambda *_: ("digest", None))
    monkeypatch.setattr("bladerub.blade.validation.read_reduced_blade", lambda _: blade)
    config["solver"]["max_time_step"] = 3e-6
    validate(config)
    config["solver"]["scheme"] = "central_differences"
    with pytest.raises(ConfigError, match=r"solver.max_time_step = 3e-06: .* below 2e-06"):
        validate(config)
    config["solver"]["max_time_step"] = 1.9e-6
    validate(config)
