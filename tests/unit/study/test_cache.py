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
    return write_run(key="a")


def is_found(path, key="a"):
    return Entry(path, key, MAPPED).fetch()


def test_a_whole_run_with_the_key_is_current_and_left_as_it_is(run):
    before = run.stat()
    assert is_found(run)
    assert not is_found(run, "b")
    assert not Entry(run, "a", MAPPED | {"strain"}).fetch()
    assert Entry(run, "a", hdf5.read(run)[0].keys()).fetch()  # it has these and no more
    assert (run.stat().st_ino, run.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)


def test_what_is_not_the_whole_run_is_not_found(run, tmp_path):
    foreign, whole = tmp_path / "foreign.h5", bytearray(run.read_bytes())
    xarray.Dataset({"wear": ("x", [1.0])}, attrs={"run_key": "a"}).to_netcdf(foreign, engine="h5netcdf")
    assert not any(map(is_found, (tmp_path / "none.h5", tmp_path, foreign)))
    with h5py.File(run) as file:
        chunk = file["wear"].id.get_chunk_info(0)
    run.write_bytes(whole[: int(0.99 * len(whole))])
    assert not is_found(run)
    whole[chunk.byte_offset + chunk.size // 2] ^= 255
    run.write_bytes(whole)
    assert not is_found(run)


def test_a_present_entry_is_archived_not_overwritten_by_the_archived_one(write_run):
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


def test_a_damaged_file_is_neither_archived_nor_taken_from_the_archive(run, write_run):
    Entry(run, "b", MAPPED).make_room()
    archived = run.parent / ARCHIVE / "a.h5"
    whole = archived.read_bytes()
    archived.rename(archived.with_stem("b"))  # of another key
    assert not is_found(run, "b")
    archived.write_bytes(whole[:1000])
    write_run(key="b")
    assert not is_found(run, "a")
    assert read_run(run).attributes["run_key"] == "b"
    os.truncate(run, 1000)
    Entry(run, "c", MAPPED).make_room()
    assert run.exists()


def test_two_blades_by_turns_compute_each_run_once_and_the_archive_may_be_deleted(
    compute, simulated, tmp_path
):
    rows, contents = {}, {}
    for number, digest in enumerate("ABABA"):
        found = compute(digest=digest)
        files = {row.file: (tmp_path / row.file).read_bytes() for row in found}
        assert rows.setdefault(digest, found) == found
        assert contents.setdefault(digest, files) == files
        assert len(simulated) == 4 * min(number + 1, 2)
    archived = list((tmp_path / ARCHIVE).iterdir())
    assert len(archived) == 4
    for path in archived:
        path.unlink()
    assert compute(digest="B") == rows["B"]
    assert len(simulated) == 3 * 4


def test_the_digest_of_a_blade_is_that_of_its_content_not_of_its_bytes_or_origin(tmp_path):
    def digest(mass, **attributes):
        variables = {"mass": Variable(("row", "column"), mass, "kg", "mass")}
        hdf5.write(tmp_path / "blade.h5", variables, {"f1_hz": 192.0, **attributes})
        return blade_digest(tmp_path / "blade.h5")

    eye, other = np.eye(3), np.eye(3)
    same = {digest(eye), digest(eye, provenance_git_commit="a")}
    with h5py.File(tmp_path / "blade.h5", "a") as file:  # other bytes, same content
        del file["mass"].attrs["long_name"]
        file["mass"].attrs["long_name"] = "mass matrix of the blade"
    assert same == {blade_digest(tmp_path / "blade.h5")}
    other[0, 0] = np.nextafter(1, 2)
    changed = [digest(each) for each in (other, eye.reshape(9, 1), eye.view(np.int64))]
    changed.append(digest(eye, eta=6))
    with h5py.File(tmp_path / "blade.h5", "a") as file:
        file.move("mass", "stiffness_0")
    changed.append(blade_digest(tmp_path / "blade.h5"))
    assert len(same.union(changed)) == 6
