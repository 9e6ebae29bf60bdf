import pytest

import bladerub as br
from bladerub.blade.cache import first_frequency


@pytest.mark.parametrize(
    ("arguments", "name"),
    [
        ({"casing": "2dn"}, "casing"),
        ({"friction": 0.1, "theta": 0.1}, "friction"),
        ({"revolutions": 2.5}, "revolutions"),
    ],
)
def test_bad_argument_is_named_with_value_and_what_is_right(study, arguments, name):
    given = {"casing": "2nd", "E": 2, "K": 0.5, "f_omega": 0.19} | arguments
    with pytest.raises(br.InputError) as caught:
        study.run(given.pop("casing"), **given)
    assert caught.value.name == name
    assert str(caught.value) == f"{name} = {caught.value.value}: {caught.value.right}"


def test_config_error_names_file_line_and_key(tmp_path):
    path = tmp_path / "bad.yaml"
    path.write_text("\nblade:\n  length: -1\n")
    with pytest.raises(br.ConfigError) as caught:
        br.load_study(path)
    assert str(caught.value).startswith(f"{path}:3: blade.length = -1")


def test_config_of_the_package_is_found_from_any_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert br.load_study("config/quick.yaml").config["blade"]["mesh"]["thickness"] == 1


def test_config_in_the_working_directory_comes_before_that_of_the_package(tmp_path, monkeypatch):
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "quick.yaml").write_text("solver: {revolutions: 30}\n")
    monkeypatch.chdir(tmp_path)
    assert br.load_study("config/quick.yaml").config["solver"]["revolutions"] == 30


def test_a_replaced_value_is_checked_and_leaves_the_study_as_it_was(study):
    damped = study.replace("contact.damping_ratio", 1e-3)
    assert damped.config["contact"]["damping_ratio"] == 1e-3
    assert damped == study.replace({"contact": {"damping_ratio": 1e-3}}) != study
    with pytest.raises(br.ConfigError, match=r"contact\.damping_ratio = 2"):
        study.replace("contact.damping_ratio", 2)


def test_a_run_in_units_is_that_in_plain_numbers(study):
    typed = study.run(
        "2nd", E="1.2 GPa", K="300MPa", f_omega="2200 rpm", damping_ratio="0.4 %", layer_thickness="4 mm"
    )
    f_omega = round(2200 / 60 / first_frequency(study.config), 6)
    own = {"damping_ratio": 0.004, "layer_thickness": 0.004}
    plain = study.run("2nd", E=2, K=0.5, f_omega=f_omega, **own)
    assert typed == plain
    assert repr(typed) == (
        f"StudyRun(2nd_E2_K0.5_theta0_xi0.004_h0.004, E = 1.2 GPa, K = 300 MPa, at {f_omega:g} of the first "
        "frequency at rest, 2,200 rpm, 20 revolutions)"
    )
