import hashlib

import pytest

from bladerub.io.checksum import file_checksum


def test_the_checksum_is_the_sha256_of_the_bytes(tmp_path):
    content = bytes(range(256)) * 2000  # longer than any buffer
    (tmp_path / "run.h5").write_bytes(content)
    assert file_checksum(tmp_path / "run.h5") == hashlib.sha256(content).hexdigest()


@pytest.mark.parametrize("bit", [0, 7, 8 * 4999 + 3, 8 * 9999 + 7])
def test_one_changed_bit_changes_the_checksum(tmp_path, bit):
    path, content = tmp_path / "run.h5", bytearray(10_000)
    path.write_bytes(content)
    before = file_checksum(path)
    content[bit // 8] ^= 1 << bit % 8
    path.write_bytes(content)
    assert file_checksum(path) != before
