import errno
from dataclasses import replace

import h5py
import numpy as np
import pytest
import xarray as xr

from bladerub.io import errors, hdf5
from bladerub.io.checksum import file_checksum
from bladerub.io.errors import DamagedFile, MissingPackage, package
from bladerub.io.hdf5 import Variable
from bladerub.io.values import equal

VARIABLES = {
    "angle": Variable(("angle",), np.linspace(0, 6, 5), "rad", "casing angle"),
    "wear": Variable(("node", "angle"), np.arange(10.0).reshape(2, 5), "m", "worn depth"),
    "energy": Variable((), 3.5, "J", "energy"),
}


def test_xarray_opens_the_file(tmp_path):
    path = tmp_path / "folder" / "file.h5"
    hdf5.write(path, VARIABLES, {"casing": "2nd", "E": 2.0})
    with xr.open_dataset(path, engine="h5netcdf", phony_dims="sort") as dataset:
        assert dataset.wear.dims == ("node", "angle")
        np.testing.assert_array_equal(dataset.wear.angle, VARIABLES["angle"].data)
        assert {("units", "m"), ("long_name", "worn depth")} <= dataset.wear.attrs.items()
        assert dataset.attrs == {"casing": "2nd", "E": 2.0, hdf5.CHECKSUM: dataset.attrs[hdf5.CHECKSUM]}
        assert dataset.energy == 3.5


def test_files_of_the_same_layout_hold_their_own_values(tmp_path):
    text = Variable(("node",), np.array(["tip", "Bürste"]), "1", "name of a node")
    long = Variable(("step",), np.arange(2000.0), "m", "peak")  # compressed
    numbers = VARIABLES | {"peak": long}
    for n in (1, 2):  # the second from the blank of the first
        changed = {name: replace(each, data=each.data * n) for name, each in numbers.items()}
        attributes = {"casing": f"casing {n}", "status": f"status {n}", "n": n, "E": 2.0 * n}
        hdf5.write(tmp_path / "file.h5", changed | {"name": text}, attributes)
        data, told = hdf5.read(tmp_path / "file.h5")
        for name, each in changed.items():
            np.testing.assert_array_equal(data[name], each.data)
        assert data["name"].tolist() == ["tip", "Bürste"]
        assert told == hdf5.read_attributes(tmp_path / "file.h5") == attributes
        np.testing.assert_array_equal(data["node"], [0, 1])

    with h5py.File(tmp_path / "file.h5") as file:
        assert (file["peak"].compression, file["peak"].fletcher32) == ("gzip", True)
    assert hdf5.read(tmp_path / "file.h5", only={"wear", "unknown"})[0].keys() == {"wear"}
    with h5py.File(tmp_path / "file.h5", "a") as file:  # of somebody who keeps more in it
        file["mine/notes"] = 1.0
    assert "mine" not in hdf5.read_any(tmp_path / "file.h5")[0]


def test_a_changed_bit_is_noticed_and_an_error_of_the_system_keeps_its_number(tmp_path):
    path = tmp_path / "file.h5"
    hdf5.write(path, VARIABLES, {})
    path.write_bytes(path.read_bytes().replace(np.float64(3.5).tobytes(), np.float64(3.25).tobytes()))
    with pytest.raises(DamagedFile, match="not as it was written"):
        hdf5.read(path)
    errors = (OSError(errno.EIO, "x"), OSError("read failed: errno = 5"), ValueError("no dataset"))
    for error, number in zip(errors, (errno.EIO, errno.EIO, None), strict=True):
        with pytest.raises(OSError, match=r"file\.h5") as told, hdf5.opened(path):
            raise error
        assert (told.value.errno, isinstance(told.value, DamagedFile)) == (number, number is None)


def test_equal_mappings_have_equal_keys_and_values():
    assert equal({"a": 1, "b": np.nan}, {"b": np.nan, "a": 1})
    assert not any(equal({"a": 1, "b": 2}, other) for other in ({"a": 1, "c": 2}, {"a": 1, "b": 3}))


def test_a_package_that_is_missing_is_named_with_its_extra():
    with pytest.raises(MissingPackage, match=r"needs no_such: pip install 'bladerub\[gpu\]'"):
        package("no_such.part", "gpu")


def test_a_file_does_not_depend_on_those_before(tmp_path):
    def write(name, n):
        variables = VARIABLES | {"energy": replace(VARIABLES["energy"], data=float(n))}
        attributes = {"status": "x" * n, "n": n, "casing": "2nd"}
        hdf5.write(tmp_path / name, variables, attributes)
        return file_checksum(tmp_path / name)

    first = write("first.h5", 3)
    write("between.h5", 50)
    assert write("again.h5", 3) == first


def test_disagreeing_lengths_are_refused_and_leave_the_old_file(tmp_path):
    path = tmp_path / "file.h5"
    hdf5.write(path, VARIABLES, {"version": 1})
    wrong = VARIABLES | {"peak": Variable(("angle",), np.zeros(4), "m", "peak")}
    with pytest.raises(ValueError, match="peak: dimension angle has 4, not 5 entries"):
        hdf5.write(path, {"peak": wrong["peak"], "angle": wrong["angle"]}, {"version": 2})
    assert hdf5.read_attributes(path) == {"version": 1}
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("read", [hdf5.read, hdf5.read_attributes])
def test_unreadable_file_is_named(tmp_path, read):
    path = tmp_path / "file.h5"
    with pytest.raises(FileNotFoundError, match=r"file\.h5"):
        read(path)
    with h5py.File(path, "w") as file:
        file["wear"] = np.zeros(100_000)
    path.write_bytes(path.read_bytes()[:2000])
    with pytest.raises(DamagedFile, match=r"file\.h5: not a readable HDF5 file"):
        read(path)


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (errors.DamagedFile("a.h5: not a map"), "a.h5: not a map; delete it and run the same command again"),
        (OSError(errno.ENOSPC, "No space left on device", "a.h5"), "a.h5: the disk is full; make room"),
        (OSError("something else"), "something else"),
        (OSError(errno.EACCES, "Permission denied", "new"), "new: Permission denied; make it writable"),
    ],
)
def test_the_program_ends_with_file_and_remedy_in_one_line(capsys, error, words):
    with pytest.raises(SystemExit) as ended, errors.exit_on_error():
        raise error
    assert ended.value.code == 2
    line = capsys.readouterr().err
    assert line.startswith(words)
    assert line.count("\n") == 1
