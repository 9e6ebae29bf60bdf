import numpy as np
import pytest
import xarray

from bladerub.io.checksum import file_checksum
from bladerub.study import store
from bladerub.study.manifest import ListedFile, ManifestRow, listed_files, read_manifest, write_manifest

OLDER = "\t".join(ManifestRow._fields[:9])


def test_a_manifest_comes_back_as_written_and_lists_runs_and_longer_runs(tmp_path):
    path = tmp_path / "manifest.tsv"
    rows = [
        ManifestRow("0.1900.h5", 0.19, "a" * 64, "completed", 70_000, checksum="e" * 64),
        ManifestRow("0.2000.h5", 0.2, "c", "unbounded", 2, "d" * 64, 3, "g", "h", 7, "i"),
    ]
    write_manifest(path, rows)
    assert path.read_text().startswith("\t".join([*ManifestRow._fields, "file checksum, sha256="]))
    assert read_manifest(path) == rows
    assert listed_files(path) == [
        ListedFile(path.with_name("0.1900.h5"), 70_000, "e" * 64),
        ListedFile(path.with_name("0.2000.h5"), 2, "g"),
        ListedFile(path.parent / "confirmation" / "0.2000.h5", 3, "h"),
    ]


@pytest.mark.parametrize(
    "content",
    [
        b"0.1900.h5\t0.1",
        b"../0.1900.h5\t0.1\tk\tcompleted\t1\t\t0\t\t\n",
        b"0.1900.h5\t0.1\tk\tcompleted\t1\t\t0\t1234\tbreaks off",
        b"0.1800.h5\t0.1\tk\tcompleted\t1\t\t0\t\t\n0.1900.h5\t0.1\tk\tcompleted\t1\t\t0\t1234\tbreaks off",
        b"x" * 200_000 + b"\n",  # more than a field of a table can be
        b"0.1900.h5\t0.1\tk\tcompleted\t1\t\t0\xff\t\t\n",
    ],
)
def test_what_is_not_a_manifest_is_an_error_with_its_name(tmp_path, content):
    path = tmp_path / "manifest.tsv"
    path.write_bytes(OLDER.encode() + b"\n" + content)
    with pytest.raises(OSError, match=r"manifest\.tsv: not a manifest"):
        read_manifest(path)


def test_a_file_is_lost_if_missing_or_of_another_size_and_damaged_if_a_bit_differs(tmp_path):
    path, content = tmp_path / "run.h5", b"0123456789"
    path.write_bytes(content)
    file = ListedFile(path, 10, file_checksum(path))
    assert (file.is_lost(), file.is_damaged()) == (False, False)
    path.write_bytes(b"1123456789")
    assert (file.is_lost(), file.is_damaged()) == (False, True)
    for other in (content[:-1], content + b"\0"):
        path.write_bytes(other)
        assert (file.is_lost(), file.is_damaged()) == (True, True)
    path.unlink()
    assert (file.is_lost(), file.is_damaged()) == (True, False)


def test_a_run_file_is_as_the_reference_says(write_run, make_result):
    result = make_result(depth=3e-4)
    path = write_run(result=result, history=True)
    with xarray.open_dataset(path, engine="h5netcdf", phony_dims="sort") as run:
        about = {"casing": "2nd", "E": 2.0, "f_omega": 0.19, "run_key": "key", "revolutions": 20}
        assert about.items() | {("n_steps", 1000), ("status", "completed")} <= run.attrs.items()
        assert run.wear.dims == ("node", "angle")
        np.testing.assert_allclose(run.wear, result.wear, rtol=1e-6, atol=1e-12)
        np.testing.assert_array_equal(run.angle, result.angle)
        assert run.spectrum_amplitude.dims == ("spectrum_order",)
        assert float(run.spectrum_amplitude.sel(spectrum_order=6)) == pytest.approx(1e-3)
        np.testing.assert_array_equal(run.revolution_number, np.arange(1, 21))
        for name in ("revolution_peak", "revolution_amplitude", "radial_displacement"):
            np.testing.assert_array_equal(run[name], getattr(result, name))
        assert [float(run[f"energy_{name}"]) for name in ("kinetic", "damping", "wear")] == [2, 4, 9]
        assert run.radial_displacement.dims == ("revolution",)
        assert run.revolution[[0, -1]].values.tolist() == pytest.approx([0.5 / 2000, 20 - 0.5 / 2000])
        assert all(variable.attrs.keys() >= {"units", "long_name"} for variable in run.variables.values())
    assert "radial_displacement" not in store.read_run(write_run(result=result)).data


def test_an_unbounded_run_keeps_wear_peaks_and_what_spectrum_there_is(write_run, make_result):
    run = store.read_run(write_run(result=make_result(complete=12.5)))
    assert run.attributes["status"] == "unbounded"
    assert run.data["wear"].max() > 0
    assert run.data["spectrum_amplitude"].max() == pytest.approx(1e-3)
    assert np.isfinite(run.data["revolution_peak"]).tolist() == [True] * 13 + [False] * 7
