"""Nothing is computed twice, a change of mind costs no run, and no damaged file passes for a whole one."""

import os

import h5py
import numpy as np
import pytest
import xarray

from bladerub.io import hdf5
from bladerub.io.hdf5 import Variable
from bladerub.study.cache import ARCHIVE, Entry, blade_digest
from bladerub.study.store import MAPPED, read_run


@pytest.fixture
def run(write_run):
    """A run file under the key "a"."""
    return write_run(key="a")


def is_found(path, key="a"):
    return Entry(path, key, MAPPED).fetch()


def written(path):
    status = path.stat()
    return status.st_ino, status.st_size, status.st_mtime_ns  # not when it was last read


class TestFetch:
    def test_a_whole_run_with_the_key_is_current(self, run):
        before = written(run)
        assert is_found(run)
        assert written(run) == before

    def test_not_a_stale_one(self, run):
        assert not is_found(run, "b")
        assert run.exists()

    def test_not_a_missing_one(self, tmp_path):
        assert not is_found(tmp_path / "none.h5")
        assert not is_found(tmp_path)

    def test_not_a_truncated_one(self, run):
        os.truncate(run, int(0.99 * run.stat().st_size))
        assert not is_found(run)

    def test_not_one_with_damaged_data(self, run):
        with h5py.File(run) as file:
            chunk = file["wear"].id.get_chunk_info(0)
        content = bytearray(run.read_bytes())
        middle = chunk.byte_offset + chunk.size // 2
        content[middle : middle + 8] = bytes(255 - byte for byte in content[middle : middle + 8])
        run.write_bytes(content)
        assert not is_found(run)

    def test_not_a_foreign_one(self, tmp_path):
        path = tmp_path / "0.1900.h5"
        xarray.Dataset({"wear": ("x", [1.0])}, attrs={"run_key": "a"}).to_netcdf(path, engine="h5netcdf")
        assert not is_found(path)
        path.write_text("run_key = a\n")
        assert not is_found(path)


class TestArchive:
    def test_a_present_entry_is_archived_not_overwritten_by_the_archived_one(self, write_run):
        contents = {}
        for key in "abc":
            path = write_run(key=key, depth=ord(key) * 1e-6)
            contents[key] = path.read_bytes()
            if key != "c":
                Entry(path, "other", MAPPED).make_room()
        for key in "abcbaac":
            assert is_found(path, key)
            assert path.read_bytes() == contents[key]
        archived = {each.stem: each.read_bytes() for each in (path.parent / ARCHIVE).iterdir()}
        assert archived == {key: contents[key] for key in "ab"}

    def test_a_damaged_file_is_not_archived(self, run):
        os.truncate(run, 1000)
        Entry(run, "b", MAPPED).make_room()
        assert run.exists()
        assert not (run.parent / ARCHIVE).exists()

    def test_a_damaged_archived_entry_is_not_taken(self, run, write_run):
        Entry(run, "b", MAPPED).make_room()
        os.truncate(run.parent / ARCHIVE / "a.h5", 1000)
        write_run(key="b")
        assert not is_found(run, "a")
        assert read_run(run).attributes["run_key"] == "b"

    def test_an_archived_entry_of_another_key_is_not_taken(self, run):
        Entry(run, "b", MAPPED).make_room()
        (run.parent / ARCHIVE / "a.h5").rename(run.parent / ARCHIVE / "b.h5")
        assert not is_found(run, "b")


class TestOfStudies:
    """Two studies in one place that differ in the blade, A and B, by turns."""

    def test_going_back_and_forth_computes_each_once(self, compute, simulated, tmp_path):
        rows, contents = {}, {}
        for number, digest in enumerate("ABABA"):
            found = compute(digest=digest)
            files = {row.file: (tmp_path / row.file).read_bytes() for row in found}
            assert rows.setdefault(digest, found) == found
            assert contents.setdefault(digest, files) == files
            assert len(simulated) == 4 * min(number + 1, 2)
        assert len(list((tmp_path / ARCHIVE).iterdir())) == 4

    def test_the_archive_may_be_deleted(self, compute, simulated, tmp_path):
        first = compute()
        compute(digest="another blade")
        for path in (tmp_path / ARCHIVE).iterdir():
            path.unlink()
        assert compute() == first
        assert len(simulated) == 3 * len(first)


class TestBladeDigest:
    @pytest.fixture
    def path(self, tmp_path):
        def write(name, mass, **attributes):
            variables = {"mass": Variable(("row", "column"), mass, "kg", "mass")}
            hdf5.write(tmp_path / name, variables, {"f1_hz": 192.0, **attributes})
            return tmp_path / name

        return write

    def test_an_identical_rebuild_keeps_it(self, path):
        first = path("a.h5", np.eye(3))
        second = path("b.h5", np.eye(3))
        with h5py.File(second, "a") as file:  # other bytes, same content
            del file["mass"].attrs["long_name"]
            file["mass"].attrs["long_name"] = "mass matrix of the blade"
        assert first.read_bytes() != second.read_bytes()
        assert blade_digest(first) == blade_digest(second)

    def test_where_it_comes_from_is_no_content(self, path):
        eye = np.eye(3)
        here, there = (path(f"{commit}.h5", eye, provenance_git_commit=commit) for commit in "ab")
        assert blade_digest(here) == blade_digest(there) == blade_digest(path("c.h5", eye))

    def test_content_changes_it(self, path):
        other = np.eye(3)
        other[0, 0] = np.nextafter(1, 2)
        digests = {
            blade_digest(path("a.h5", np.eye(3))),
            blade_digest(path("b.h5", other)),
            blade_digest(path("c.h5", np.eye(3), eta=6)),
            blade_digest(path("d.h5", np.eye(3).astype(np.float32))),
            blade_digest(path("e.h5", np.eye(9).reshape(27, 3)[::4].copy())),
        }
        assert len(digests) == 5
