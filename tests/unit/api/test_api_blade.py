import numpy as np
import pytest
import xarray as xr

import bladerub as br


def test_blade_is_built_once(study, blade, small, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    written = blade.path.stat().st_mtime_ns
    assert br.build_blade(study).path == blade.path
    assert blade.path.stat().st_mtime_ns == written


def test_blade_goes_to_xarray_and_pandas(blade):
    with xr.open_dataset(blade.path, engine="h5netcdf", phony_dims="sort") as opened:
        xr.testing.assert_identical(blade.to_xarray(), opened.load())
    assert {"f_omega", "mode", "f_fe", "f_rom"} <= set(blade.accuracy().columns)


def test_a_doubtful_blade_gets_a_warning(study, blade, small, monkeypatch):
    monkeypatch.setenv("BLADERUB_CACHE", str(small / "cache"))
    figures = {**study.config["figures"], "nominal_speed": 6e4}
    with pytest.warns(UserWarning, match="beyond reduction.f_omega_max = 0.4"):
        br.build_blade(br.Study({**study.config, "figures": figures}, study.folder))


def test_frequencies_at_several_speeds(blade):
    np.testing.assert_array_equal(
        blade.frequencies([0.0, 0.2], 2), [blade.frequencies(speed, 2) for speed in (0.0, 0.2)]
    )
