import pytest

import bladerub as br


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
