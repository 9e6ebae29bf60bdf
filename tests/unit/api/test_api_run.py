import numpy as np
import pytest
import xarray as xr

import bladerub as br


def test_speed_beyond_the_blade_is_named(study, blade):
    with pytest.raises(br.InputError) as caught:
        br.simulate(blade, study.run("2nd", E=2, K=0.5, f_omega=0.45))
    assert caught.value.name == "f_omega"


def test_written_run_is_read_with_the_same_arrays(study, run, tmp_path):
    run.write(tmp_path / "0.1900.h5", study.config)
    read = br.read_run(tmp_path / "0.1900.h5")
    assert read.stored.data.keys() == run.stored.data.keys()
    xr.testing.assert_equal(read.to_xarray(), run.to_xarray())
    assert run.attributes.items() <= read.attributes.items()
    for name, data in run.stored.data.items():
        np.testing.assert_array_equal(read.stored.data[name], data)
    assert read.energy == run.energy
    assert read.case == run.case


def test_run_in_xarray_is_what_xarray_opens(study, run, tmp_path):
    run.write(tmp_path / "0.1900.h5", study.config)
    with xr.open_dataset(tmp_path / "0.1900.h5", engine="h5netcdf", phony_dims="sort") as opened:
        xr.testing.assert_equal(run.to_xarray(), opened.load())
        assert {name: run.to_xarray()[name].attrs["units"] for name in opened} == {
            name: opened[name].attrs["units"] for name in opened
        }


def test_run_in_pandas_has_a_row_for_each_revolution(run):
    table = run.to_pandas()
    assert list(table.index) == [1, 2, 3]
    np.testing.assert_array_equal(table["revolution_peak"], run.revolution_peak)


def test_progress_and_each_count_the_revolutions(study, blade, capsys):
    done = []
    asked = study.run("2nd", E=2, K=0.5, f_omega=0.19, revolutions=2)
    br.simulate(blade, asked, follow=False, progress=True, each=done.append)
    assert done == [1, 2]
    assert "rev" in capsys.readouterr().err


def test_growing_run_is_followed_further(study, blade):
    asked, settings = study.run("2nd", E=2, K=0.5, f_omega=0.2), study.config["analysis"]["divergence"]
    run, short = br.simulate(blade, asked), br.simulate(blade, asked, follow=False)
    assert short.longer is None
    assert run.longer.revolutions == settings["confirmation_revolutions"]
    assert run.verdict(settings).revolutions == run.longer.revolutions > short.verdict(settings).revolutions


def test_run_shows_itself(run):
    assert "<caption>Run</caption>" in run._repr_html_()
    for draw in (run.plot_wear, run.plot_history, run.plot_spectrum):
        assert draw()._repr_html_().startswith("<img")
