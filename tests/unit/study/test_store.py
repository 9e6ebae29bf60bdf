import h5py
import numpy as np
import pytest
import xarray

from bladerub.study import store
from bladerub.study.store import ManifestRow


@pytest.fixture
def write(tmp_path, spec, case, config, make_result):
    def write_to(name="0.1900.h5", result=None, key="key", history=False):
        path = tmp_path / name
        store.write_run(path, spec, result or make_result(), case, key, config, history)
        return path

    return write_to


def open_with_xarray(path):
    return xarray.open_dataset(path, engine="h5netcdf", phony_dims="sort")


def test_a_run_file_is_as_the_readme_says(write, make_result):
    result = make_result(depth=3e-4)
    with open_with_xarray(write(result=result)) as run:
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
        assert [float(run[f"energy_{name}"]) for name in ("kinetic", "damping", "wear")] == [2, 4, 8]
        assert "radial_displacement" not in run
        for variable in run.variables.values():
            assert variable.attrs["units"]
            assert variable.attrs["long_name"]


def test_a_listed_run_keeps_its_history(write, make_result):
    result = make_result()
    with open_with_xarray(write(result=result, history=True)) as run:
        np.testing.assert_array_equal(run.radial_displacement, result.radial_displacement)
        assert run.radial_displacement.dims == ("revolution",)
        assert float(run.revolution[0]) == pytest.approx(0.5 / 2000)
        assert float(run.revolution[-1]) == pytest.approx(20 - 0.5 / 2000)


def test_an_unbounded_run_keeps_wear_peaks_and_what_spectrum_there_is(write, make_result):
    run = store.read_run(write(result=make_result(complete=12.5)))
    assert run.attributes["status"] == "unbounded"
    assert run.data["wear"].max() > 0
    assert run.data["spectrum_amplitude"].max() == pytest.approx(1e-3)
    assert np.isfinite(run.data["revolution_peak"][:13]).all()
    assert np.isnan(run.data["revolution_peak"][13:]).all()


def test_a_run_is_small_on_disk(write):
    assert write().stat().st_size < 90e3  # 10,900 runs stay below a gigabyte


class TestIsCurrent:
    def test_a_whole_run_with_the_key(self, write):
        assert store.is_current(write(key="a"), "a")

    def test_not_a_stale_one(self, write):
        assert not store.is_current(write(key="a"), "b")

    def test_not_a_missing_one(self, tmp_path):
        assert not store.is_current(tmp_path / "none.h5", "a")
        assert not store.is_current(tmp_path, "a")

    @pytest.mark.parametrize("share", [0.0, 0.3, 0.99])
    def test_not_a_truncated_one(self, write, share):
        path = write(key="a")
        content = path.read_bytes()
        path.write_bytes(content[: int(share * len(content))])
        assert not store.is_current(path, "a")

    def test_not_one_with_damaged_data(self, write):
        path = write(key="a")
        with h5py.File(path) as file:
            chunk = file["wear"].id.get_chunk_info(0)
        content = bytearray(path.read_bytes())
        middle = chunk.byte_offset + chunk.size // 2
        content[middle : middle + 8] = bytes(255 - byte for byte in content[middle : middle + 8])
        path.write_bytes(content)
        assert not store.is_current(path, "a")

    def test_not_a_foreign_one(self, tmp_path):
        path = tmp_path / "0.1900.h5"
        xarray.Dataset({"wear": ("x", [1.0])}, attrs={"run_key": "a"}).to_netcdf(path, engine="h5netcdf")
        assert not store.is_current(path, "a")
        path.write_text("run_key = a\n")
        assert not store.is_current(path, "a")


@pytest.mark.parametrize("content", [None, b"", b"not HDF5"])
def test_reading_what_is_not_a_run_names_the_file(tmp_path, content):
    path = tmp_path / "0.1900.h5"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(OSError, match=r"0\.1900\.h5"):
        store.read_run(path)


HEADER = "file\tf_omega\trun_key\tstatus\tbytes\tconfirmation_key\tconfirmation_bytes"


def test_manifest_comes_back_as_written(tmp_path):
    rows = [
        ManifestRow("0.1900.h5", 0.19, "a" * 64, "completed", 70_000),
        ManifestRow("0.1970.h5", 0.197, "b", "unbounded", 1),
        ManifestRow("0.2000.h5", 0.2, "c", "completed", 2, "d" * 64, 3),
    ]
    path = tmp_path / "manifest.tsv"
    store.write_manifest(path, rows)
    assert path.read_text().splitlines()[0] == HEADER
    assert store.read_manifest(path) == rows
    assert [entry.name for entry in tmp_path.iterdir()] == ["manifest.tsv"]


@pytest.mark.parametrize(
    "content",
    ["", "a\tb\n", f"{HEADER}\n0.1900.h5\tfast\tk\tcompleted\t1\t\t0\n", f"{HEADER}\n0.1900.h5\t0.1"],
)
def test_what_is_not_a_manifest_is_an_error_with_its_name(tmp_path, content):
    path = tmp_path / "manifest.tsv"
    path.write_text(content)
    with pytest.raises(OSError, match=r"manifest\.tsv: not a manifest"):
        store.read_manifest(path)
