import numpy as np
import pytest
import xarray as xr

import bladerub as br


def test_two_jobs_give_the_bits_of_one(study, blade, sweep):
    again = br.simulate_speeds(blade, study.coating("2nd", E=2, K=0.5), [0.19, 0.2], jobs=2, progress=False)
    xr.testing.assert_identical(again.to_xarray(), sweep.to_xarray())


def test_speeds_ascend_and_are_the_single_runs(study, blade, sweep):
    assert sweep.f_omega.tolist() == [0.19, 0.2]
    single = br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.19), follow=False)
    np.testing.assert_array_equal(sweep.wear[0], single.wear.mean(axis=0))


@pytest.mark.parametrize("speeds", [[0.2], [0.2, 0.2], [0.2, 0.45]])
def test_speeds_that_make_no_map_are_named(study, blade, speeds):
    with pytest.raises(br.InputError) as caught:
        br.simulate_speeds(blade, study.coating("2nd", E=2, K=0.5), speeds, progress=False)
    assert caught.value.name == "speeds"


def test_written_map_is_what_xarray_opens_and_read_map_reads(study, sweep, tmp_path):
    path = tmp_path / "map.h5"
    sweep.write(path, study.config)
    xr.testing.assert_identical(br.read_map(path).to_xarray(), sweep.to_xarray())
    with xr.open_dataset(path, engine="h5netcdf", phony_dims="sort") as opened:
        xr.testing.assert_equal(opened.load(), sweep.to_xarray())
