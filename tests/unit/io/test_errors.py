import errno
import os
from pathlib import Path

import pytest

from bladerub.io import errors


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (errors.DamagedFile("a.h5: not a map"), "a.h5: not a map; delete it and run the same command again"),
        (OSError(errno.ENOSPC, "No space left on device", "a.h5"), "a.h5: the disk is full; make room"),
        (OSError(errno.EROFS, "Read-only file system", "runs"), "runs: Read-only file system; make it"),
        (OSError(errno.ENOENT, os.strerror(errno.ENOENT), "a"), "a: No such file or directory"),
        (OSError("something else"), "something else"),
    ],
)
def test_file_and_remedy_in_one_line(error, words):
    line = errors.message_for(error)
    assert line.startswith(words)
    assert "\n" not in line


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (OSError(errno.EROFS, "Read-only file system", "results"), "results: Read-only file system"),
        (errors.BadInput("E = -1: must be positive\nK = x: must be a number"), "E = -1: must be positive\nK"),
    ],
)
def test_the_program_ends_without_a_traceback(error, words, capsys):
    with pytest.raises(SystemExit) as ended, errors.exit_on_error():
        raise error
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith(words)


def test_what_may_not_be_read_is_to_be_made_readable(tmp_path, monkeypatch):
    file = tmp_path / "mass.mtx"
    file.touch()
    error = OSError(errno.EACCES, "Permission denied", str(file))
    assert "; make it writable" in errors.message_for(error)
    monkeypatch.setattr(errors.os, "access", lambda path, mode: Path(path) != file)
    assert errors.message_for(error) == f"{file}: Permission denied; make it readable"
