import numpy as np
import pytest
import xarray

from bladerub.study import store


def open_with_xarray(path):
    return xarray.open_dataset(path, engine="h5netcdf", phony_dims="sort")


def test_a_run_file_is_as_the_reference_says(write_run, make_result):
    result = make_result(depth=3e-4)
    with open_with_xarray(write_run(result=result)) as run:
        assert {name: run.attrs[name] for name in ("casing", "E", "K", "theta", "f_omega")} == {
            "casing": "2nd",
            "E": 2.0,
            "K": 0.5,
            "theta": 0.15,
            "f_omega": 0.19,
        }
        assert (run.attrs["revolutions"], run.attrs["n_steps"], run.attrs["time_step"]) == (20, 1000, 2e-7)
        assert (run.attrs["run_key"], run.attrs["status"]) == ("key", "completed")
        assert run.wear.dims == ("node", "angle")
        assert run.wear.shape == (8, 2000)
        np.testing.assert_allclose(run.wear, result.wear, rtol=1e-6, atol=1e-12)
        np.testing.assert_array_equal(run.angle, result.angle)
        assert run.spectrum_amplitude.dims == ("spectrum_order",)
        assert float(run.spectrum_amplitude.sel(spectrum_order=6)) == pytest.approx(1e-3)
        np.testing.assert_array_equal(run.revolution_number, np.arange(1, 21))
        np.testing.assert_array_equal(run.revolution_peak, result.revolution_peak)
        assert run.revolution_amplitude.dims == ("revolution_number",)
        np.testing.assert_array_equal(run.revolution_amplitude, result.revolution_amplitude)
        assert [float(run[f"energy_{name}"]) for name in ("kinetic", "damping", "wear")] == [2, 4, 9]
        assert "radial_displacement" not in run
        for variable in run.variables.values():
            assert variable.attrs["units"]
            assert variable.attrs["long_name"]


def test_a_listed_run_keeps_its_history(write_run, make_result):
    result = make_result()
    with open_with_xarray(write_run(result=result, history=True)) as run:
        np.testing.assert_array_equal(run.radial_displacement, result.radial_displacement)
        assert run.radial_displacement.dims == ("revolution",)
        assert float(run.revolution[0]) == pytest.approx(0.5 / 2000)
        assert float(run.revolution[-1]) == pytest.approx(20 - 0.5 / 2000)


def test_an_unbounded_run_keeps_wear_peaks_and_what_spectrum_there_is(write_run, make_result):
    run = store.read_run(write_run(result=make_result(complete=12.5)))
    assert run.attributes["status"] == "unbounded"
    assert run.data["wear"].max() > 0
    assert run.data["spectrum_amplitude"].max() == pytest.approx(1e-3)
    assert np.isfinite(run.data["revolution_peak"][:13]).all()
    assert np.isnan(run.data["revolution_peak"][13:]).all()
