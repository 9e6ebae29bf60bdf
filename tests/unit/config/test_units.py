"""One study typed in units and in plain numbers, and what is said of units that cannot be."""

import pytest

from bladerub.blade.build import frequency_at_rest
from bladerub.blade.cache import first_frequency, kept_frequency
from bladerub.blade.files import made_from
from bladerub.config.quantities import number, references
from bladerub.config.read import read
from bladerub.io.folders import ROOT
from bladerub.study.grid import coating_cases, run_spec
from bladerub.study.plan import coating_plan

COARSE = "blade: {mesh: {chordwise: 8, thickness: 1, spanwise: 4}}\n"
TYPED = """
blade:
  material: {young_modulus: 110 GPa, density: 4.43 g/cm3}
  hub_radius: 458.2 mm
  length: 20cm
  tip_cone: 12.45 deg
contact:
  modulus_unit: 600 MPa
  yield_stress: 9 Pa
  layer_thickness: 6 mm
  tip_profile: {edge_drop: 20 µm}
  clearance: {leading_edge: 0.03 mm, trailing_edge: 0.043 %}
  damping_ratio: 0.23 %
casings: {2nd: {amplitude: 1 mm, interference: 500 um, start_angle: 90 deg}}
coatings:
  - {casing: 2nd, E: [66 MPa, 1.2 GPa], K: [300 MPa], theta: [0, 0.15 rad], layer_thickness: [4 mm]}
reduction: {f_omega_max: 4800 rpm}
speeds: {start: 2000 rpm, stop: 4800 rpm, step: 200 rpm, extra: [37.5 Hz]}
"""
PLAIN = """
blade: {{tip_cone: 12.45}}
contact: {{damping_ratio: 2.3e-3}}
coatings:
  - {{casing: 2nd, E: [0.11, 2], K: [0.5], theta: [0.0, 0.15], layer_thickness: [4.0e-3]}}
reduction: {{f_omega_max: {f_omega_max}}}
speeds: {{start: {start}, stop: {stop}, step: {step}, extra: [{extra}]}}
"""


@pytest.fixture
def study(tmp_path, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(tmp_path / "cache"))

    def read_over(text):
        path = tmp_path / "my.yaml"
        path.write_text(COARSE)
        over = tmp_path / "over.yaml"
        over.write_text(text)
        return read(ROOT / "config" / "config.yaml", path, over)

    return read_over


def keys(config):
    plans = (coating_plan(config, case) for case in coating_cases(config))
    return {f"{plan.case.name}/{run.file}": run.key("") for plan in plans for run in plan.runs}


def test_a_study_has_the_same_keys_in_units_and_in_plain_numbers(study):
    typed = study(TYPED)
    rpm = 1 / 60 / first_frequency(typed)
    speeds = {"f_omega_max": 4800, "start": 2000, "stop": 4800, "step": 200, "extra": 2250}
    plain = study(PLAIN.format(**{name: f"{n * rpm:.12g}" for name, n in speeds.items()}))
    assert keys(typed) == keys(plain)
    assert len(keys(typed)) == 4 * 16
    assert made_from(typed) == made_from(plain)


def test_the_first_frequency_is_that_of_the_blade_and_kept(study):
    config = study("{}")
    assert kept_frequency(config) is None
    assert first_frequency(config) == pytest.approx(frequency_at_rest(config), rel=1e-8)
    assert kept_frequency(config) == first_frequency(config)


@pytest.mark.extras
def test_a_quantity_is_not_scaled_and_a_plain_number_is(study):
    scale = "scale: {length: 2, modulus: 3, time: 1}"
    texts = [f"contact: {{layer_thickness: {h}, {scale}}}\nfigures: {{dpi: 160}}\n" for h in ("6 mm", 6e-3)]
    (case, *_), configs = coating_cases(study(texts[0])), list(map(study, texts))
    thickness = [run_spec(config, case, 0.19).coating.thickness for config in configs]
    assert thickness == pytest.approx([6e-3, 12e-3])
    assert number("E", "1.8 GPa", references(configs[0])) == 1.0


@pytest.mark.extras(cases=r"law")
@pytest.mark.parametrize(
    ("setting", "words"),
    [
        ("speeds: {start: 2000 mm}", "is a length; must be a speed: rpm, Hz, rad/s"),
        ("reduction: {f_omega_max: 80 kHz}", 'unknown unit "kHz", did you mean Hz?'),
        ("contact: {elements: 2000 %}", "is a share; must be a whole number without a unit"),
        ("contact: {law: {name: viscoplastic, viscosity: 1 mm}}", "must be a number in the unit"),
        ("coatings: [{casing: 2nd, E: [3.0e+8], K: [1], theta: [0]}]", 'write "300 MPa"'),
        ("coatings: [{casing: 2nd, E: [1,2 GPa], K: [1], theta: [0]}]", "must be all with a unit"),
        ('contact: {layer_thickness: "4,5 mm"}', "a decimal has a point"),
    ],
)
def test_a_wrong_unit_is_named_with_the_right_ones(study, problems, setting, words):
    assert any(words in problem.text for problem in problems(setting, by=study))


@pytest.mark.extras(cases=r"law")
@pytest.mark.parametrize(
    ("cause", "culprit"),
    [("blade: {sections: []}", "blade.sections"), ("contact: {law: {name: plastik}}", "contact.law.name")],
)
def test_a_reference_that_is_not_known_hides_no_cause(study, problems, cause, culprit):
    typed = "reduction: {f_omega_max: 80 Hz}\ncoatings: [{casing: 2nd, E: [1 GPa], K: [1], theta: [0]}]"
    (problem,) = problems(f"{typed}\n{cause}", by=study)
    assert problem.text.startswith(f"{culprit} = ")
