import os
import threading
import time
from unittest.mock import Mock

import pytest

from bladerub.io import atomic, lock
from bladerub.io.folders import CONFIG, cache_folder, study_folder

HALF_WRITTEN = """
import sys
from bladerub.io import atomic
with atomic.writing(sys.argv[1]) as stream:
    stream.write("new" * 10_000)
    stream.flush()
    print("half", flush=True)
    sys.stdin.read()
"""
HOLDER = """
import sys
from bladerub.io import lock
with lock.held(sys.argv[1], lambda: None):
    print("held", flush=True)
    sys.stdin.read()
"""


def test_an_error_leaves_the_old_file_and_nothing_else(tmp_path):
    path = tmp_path / "file"
    path.write_text("old")
    with pytest.raises(ZeroDivisionError), atomic.writing(path) as stream:
        stream.write(str(1 / 0))
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("folder", [".", "", "folder"])
def test_a_folder_in_the_place_of_the_file_is_named(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "folder").mkdir()
    with pytest.raises(OSError, match=f"'{folder or '.'}'"), atomic.writing(folder) as stream:
        stream.write("new")
    assert [path.name for path in tmp_path.iterdir()] == ["folder"]


def test_a_kill_leaves_the_old_file_and_a_temporary_one_that_is_swept(tmp_path, python_at_work):
    path = tmp_path / "file"
    path.write_text("old")
    process = python_at_work(HALF_WRITTEN, path)
    atomic.delete_abandoned(tmp_path.parent)
    assert len(list(tmp_path.iterdir())) == 2  # it lives, and its file stays
    process.kill()
    process.wait()
    assert path.read_text() == "old"
    assert len(list(tmp_path.iterdir())) == 2
    atomic.delete_abandoned(tmp_path.parent)
    assert list(tmp_path.iterdir()) == [path]


def test_of_another_host_only_what_is_old_is_swept(tmp_path, monkeypatch):
    names = (".a.node1.7.tmp", ".b.node1.7.tmp", ".b.tmp", f".c.{atomic._HOST}.7.tmp")
    fresh, old, foreign, other = (tmp_path / name for name in names)
    monkeypatch.setattr(atomic.os, "kill", Mock(side_effect=PermissionError))  # of another user
    for path, age in ((fresh, 3500), (old, 3700), (foreign, 3700), (other, 3700)):
        path.touch()
        os.utime(path, (time.time() - age, time.time() - age))
    atomic.delete_abandoned(tmp_path)
    assert sorted(tmp_path.iterdir()) == [fresh, foreign, other]
    monkeypatch.setattr(atomic, "_is_abandoned", lambda path, *_: path.unlink() is None)
    atomic.delete_abandoned(tmp_path)  # another process swept it meanwhile
    assert sorted(tmp_path.iterdir()) == [foreign]


@pytest.mark.parametrize("mode", ["w", "wb"])
def test_the_content_is_on_the_disk_before_the_file_gets_its_name(tmp_path, monkeypatch, mode):
    """What Python still buffers when the file is synchronised would be lost with the power."""
    path, sync, rename, steps = tmp_path / "new" / "folder" / "file", os.fsync, os.replace, []

    def synchronised(descriptor):
        steps.append(("synchronised", os.fstat(descriptor).st_size))
        sync(descriptor)

    def renamed(source, target):
        steps.append(("renamed", os.stat(source).st_size))
        rename(source, target)

    monkeypatch.setattr(atomic.os, "fsync", synchronised)
    monkeypatch.setattr(atomic.os, "replace", renamed)
    with atomic.writing(path, mode) as stream:
        stream.write("sev\u00e4n\n\n" if mode == "w" else b"sev\xc3\xa4n\n\n")
        assert not path.exists()
    assert steps == [("synchronised", 8), ("renamed", 8)]
    assert path.read_bytes() == b"sev\xc3\xa4n\n\n"
    assert list(path.parent.iterdir()) == [path]


def test_the_second_to_ask_gets_no_further_before(tmp_path):
    waits, holds = threading.Event(), threading.Event()

    def hold():
        with lock.held(tmp_path / "lock", waits.set):
            holds.set()

    second = threading.Thread(target=hold)
    with lock.held(tmp_path / "lock", lambda: None):
        second.start()
        assert waits.wait(timeout=60)
        assert not holds.wait(timeout=0.2)
    second.join(timeout=60)
    assert holds.is_set()


def test_a_killed_holder_leaves_no_lock(tmp_path, python_at_work):
    waited, holder = [], python_at_work(HOLDER, tmp_path / "lock")
    holder.kill()
    holder.wait()
    with lock.held(tmp_path / "lock", lambda: waited.append(1)):
        pass
    assert waited == []


@pytest.fixture
def homeless(tmp_path, monkeypatch):
    """A user without a home, as in a container under a foreign number."""
    for name in ("BLADERUB_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "nonexistent"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path / f"bladerub-{os.getuid()}"


def test_a_user_without_a_home_keeps_things_where_nobody_else_writes(homeless):
    for _ in range(2):
        assert cache_folder() == homeless
        assert homeless.stat().st_mode & 0o777 == 0o700
    homeless.chmod(0o702)
    with pytest.raises(OSError, match="BLADERUB_CACHE"):
        cache_folder()


@pytest.mark.parametrize("name", ["BLADERUB_CACHE", "XDG_CACHE_HOME"])
def test_a_folder_that_is_named_is_used(homeless, tmp_path, monkeypatch, name):
    monkeypatch.setenv(name, str(tmp_path / "named"))
    assert cache_folder().is_relative_to(tmp_path / "named")


def test_a_study_is_found_from_a_folder_in_it_whatever_the_encoding_of_its_snakefile(tmp_path, monkeypatch):
    for name, content in ((CONFIG, b""), ("Snakefile", b"# \xe4 bladerub"), ("results/maps/a", b"")):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(content)
    monkeypatch.chdir(tmp_path / "results" / "maps")
    assert study_folder() == tmp_path
