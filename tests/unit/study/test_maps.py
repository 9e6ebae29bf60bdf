import dataclasses
import math

import numpy as np
import pytest
import xarray

from bladerub.io import tables
from bladerub.io.checksum import file_checksum
from bladerub.io.errors import DamagedFile
from bladerub.study import divergence, grid, maps, peaks, store
from bladerub.study.growth import confirmation_spec
from bladerub.study.manifest import (
    ListedFile,
    ManifestRow,
    confirmation_path,
    listed_files,
    read_manifest,
    write_manifest,
)

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


SPEEDS = [0.1, 0.19, 0.3]


@pytest.fixture
def folder(tmp_path, config, case, make_result, write_run):
    """Runs that vibrate and wear at orders 10, 6, 4; the middle one, and in vain the last, are repeated."""
    rows = []
    for f_omega, order in zip(SPEEDS, (10, 6, 4), strict=True):
        result = make_result(order=order, complete=15 if order == 4 else None)
        spec = grid.run_spec(config, case, f_omega)
        name = f"{grid.speed_name(f_omega)}.h5"
        write_run(name, f"key {order}", result, history=order == 6, spec=spec)
        if order != 10:
            long_spec = confirmation_spec(spec, config.analysis.divergence)
            longer = make_result(revolutions=60, growth=0.03)
            write_run(f"confirmation/{name}", f"long {order}", longer, spec=long_spec)
        long_key = "long 6" if order == 6 else ""
        rows.append(ManifestRow(name, f_omega, f"key {order}", result.status, 1, long_key, 1))
    write_manifest(tmp_path / "manifest.tsv", reversed(rows))
    return tmp_path


@pytest.fixture
def collect(config, case, blade, folder):
    rows = read_manifest(folder / "manifest.tsv")
    return lambda: maps.collect_listed(config, case, blade, folder, rows)


def test_a_map_gathers_the_runs_by_speed(collect, make_result):
    coating = collect()
    np.testing.assert_array_equal(coating.f_omega, SPEEDS)
    np.testing.assert_allclose(coating.C1, np.sqrt(1 + 3 * np.square(SPEEDS)))
    assert list(coating.lobes) == [10, 6, 4]
    assert list(coating.status) == ["completed", "completed", "unbounded"]
    assert [coating.spectrum_order[row.argmax()] for row in coating.spectrum_amplitude] == [10, 6, 4]
    assert coating.revolution_peak.shape == coating.revolution_amplitude.shape == (3, 20)
    assert coating.confirmation_amplitude.shape == (3, 60)
    np.testing.assert_allclose(coating.confirmation_amplitude[1], 1e-3 * 1.03 ** np.arange(60), rtol=1e-4)
    assert np.isnan(coating.confirmation_amplitude[[0, 2]]).all()
    np.testing.assert_allclose(coating.max_wear, 2e-4, rtol=1e-3)
    wear = make_result(order=6).wear
    np.testing.assert_allclose(coating.wear_node[1], wear, atol=1e-10)
    np.testing.assert_allclose(coating.wear[1], wear.mean(axis=0), atol=1e-10)


def test_a_map_comes_back_as_written(tmp_path, case, make_map):
    written = make_map(case, {4: (0.3, 1e-4)}, status="completed")
    maps.write_map(tmp_path / "map.h5", written, {})
    assert maps.read_map(tmp_path / "map.h5").wear_node is None
    read = maps.read_map(tmp_path / "map.h5", with_nodes=True)
    assert read.case == case
    for field in dataclasses.fields(written)[1:]:
        np.testing.assert_array_equal(getattr(read, field.name), getattr(written, field.name))


@pytest.mark.parametrize("which", ["runs", "longer runs"])
def test_a_run_that_is_damaged_missing_or_stale_is_named(collect, folder, which):
    paths = [folder / "0.1900.h5", folder / "0.3000.h5"]
    path, other = paths if which == "runs" else map(confirmation_path, paths)
    name = path.relative_to(folder)
    path.write_bytes(path.read_bytes()[:5000])
    with pytest.raises(DamagedFile, match=rf"{name}: not a readable HDF5 file"):
        collect()
    path.write_bytes(other.read_bytes())
    with pytest.raises(OSError, match=rf"{name}: not the run that .*manifest\.tsv lists"):
        collect()
    path.unlink()
    with pytest.raises(OSError, match=rf"No such file .*{name}"):
        collect()


def test_the_rigid_casing_is_in_the_tables_as_a_coating_of_infinite_moduli(config, make_map, tmp_path):
    case = grid.CoatingCase.rigid("2nd", 0.15)
    maps.write_map(tmp_path / "map.h5", make_map(case, {4: (0.31, 1e-4), 6: (0.2, 1e-4)}, lobes=0), {})
    coating = maps.read_map(tmp_path / "map.h5")
    assert coating.case == case
    for table in (peaks.table, divergence.table):
        tables.write(tmp_path / "table.csv", table(config, [coating]), {})
        read = tables.read(tmp_path / "table.csv")
        assert (np.isinf(read.E) & np.isinf(read.K)).all()
        assert read.theta.to_numpy() == pytest.approx(math.atan(0.15))
        assert not read.drop(columns=["E", "K"]).isna().any(axis=None)
