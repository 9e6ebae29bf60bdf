import errno

import pytest

from bladerub.io import errors


@pytest.mark.parametrize(
    ("error", "words"),
    [
        (errors.DamagedFile("a.h5: not a map"), "a.h5: not a map; delete it and run the same command again"),
        (OSError(errno.ENOSPC, "No space left on device", "a.h5"), "a.h5: the disk is full; make room"),
        (OSError("something else"), "something else"),
    ],
)
def test_file_and_remedy_in_one_line(error, words):
    line = errors.message_for(error)
    assert line.startswith(words)
    assert "\n" not in line


def test_the_program_ends_without_a_traceback(capsys):
    with pytest.raises(SystemExit) as ended, errors.exit_on_error():
        raise OSError(errno.EROFS, "Read-only file system", "results")
    assert ended.value.code == 2
    assert capsys.readouterr().err.startswith("results: Read-only file system")
