import numpy as np
import pytest
import xarray as xr

import bladerub as br
from bladerub.blade.cache import first_frequency


def test_bad_argument_is_named_with_value_and_what_is_right(study):
    for arguments, name in (
        ({"casing": "2dn"}, "casing"),
        ({"friction": 0.1, "theta": 0.1}, "friction"),
        ({"revolutions": 2.5}, "revolutions"),
    ):
        given = {"casing": "2nd", "E": 2, "K": 0.5, "f_omega": 0.19} | arguments
        with pytest.raises(br.InputError) as caught:
            study.run(given.pop("casing"), **given)
        assert caught.value.name == name
        assert str(caught.value) == f"{name} = {caught.value.value}: {caught.value.right}"
    for settings in (None, 5, [1]):
        with pytest.raises(br.InputError, match="settings = "):
            br.Study.from_settings(settings)


def test_a_wrong_value_is_named_with_file_line_and_key_and_a_replaced_one_leaves_the_study_as_it_was(
    tmp_path, study
):
    path = tmp_path / "bad.yaml"
    path.write_text("\nblade:\n  length: -1\n")
    with pytest.raises(br.ConfigError) as caught:
        br.load_study(path)
    assert str(caught.value).startswith(f"{path}:3: blade.length = -1")
    damped = study.replace("contact.damping_ratio", 1e-3)
    assert damped.config.contact.damping_ratio == 1e-3
    assert damped == study.replace({"contact": {"damping_ratio": 1e-3}}) != study
    with pytest.raises(br.ConfigError, match=r"contact\.damping_ratio = 2"):
        study.replace("contact.damping_ratio", 2)


def test_a_config_is_found_in_the_working_directory_or_the_package(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert br.load_study("config/quick.yaml").config.blade.mesh.thickness == 1
    (tmp_path / "config").mkdir()
    (tmp_path / "config" / "quick.yaml").write_text("solver: {revolutions: 30}\n")
    assert br.load_study("config/quick.yaml").config.solver.revolutions == 30


def test_a_run_in_units_is_that_in_plain_numbers(study):
    own = {"damping_ratio": "0.4 %", "layer_thickness": "4 mm"}
    typed = study.run("2nd", E="1.2 GPa", K="300MPa", f_omega="2200 rpm", **own)
    f_omega = round(2200 / 60 / first_frequency(study.config), 6)
    own = {"damping_ratio": 0.004, "layer_thickness": 0.004}
    assert typed == study.run("2nd", E=2, K=0.5, f_omega=f_omega, **own)


def test_blade_is_built_once_and_goes_to_xarray_and_pandas(study, blade, small, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    written = blade.path.stat().st_mtime_ns
    assert br.build_blade(study).path == blade.path
    assert blade.path.stat().st_mtime_ns == written
    with xr.open_dataset(blade.path, engine="h5netcdf", phony_dims="sort") as opened:
        xr.testing.assert_identical(blade.to_xarray(), opened.load())
    assert {"f_omega", "mode", "f_fe", "f_rom"} <= set(blade.accuracy().columns)
    single = [blade.frequencies(speed, 2) for speed in (0.0, 0.2)]
    np.testing.assert_array_equal(blade.frequencies([0.0, 0.2], 2), single)


@pytest.mark.extras
def test_a_doubtful_blade_gets_a_warning(study, blade, small, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    fast = study.config.replaced("figures.nominal_speed", 6e4)
    with pytest.warns(UserWarning, match="beyond reduction.f_omega_max = 0.4"):
        br.build_blade(br.Study(fast, study.folder))


@pytest.mark.extras
def test_speeds_ascend_and_are_the_single_runs_whatever_the_jobs(study, blade, sweep):
    coating = study.coating("2nd", E=2, K=0.5)
    again = br.simulate_speeds(blade, coating, [0.19, 0.2], jobs=2, progress=False)
    xr.testing.assert_identical(again.to_xarray(), sweep.to_xarray())
    assert sweep.f_omega.tolist() == [0.19, 0.2]
    single = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19), follow=False)
    np.testing.assert_array_equal(sweep.wear[0], single.wear.mean(axis=0))
    for speeds in ([0.2], [0.2, 0.2], [0.2, 0.45]):
        with pytest.raises(br.InputError) as caught:
            br.simulate_speeds(blade, coating, speeds, progress=False)
        assert caught.value.name == "speeds"
