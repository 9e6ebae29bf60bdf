import os

import pytest

from bladerub.io.folders import cache_folder


@pytest.fixture
def homeless(tmp_path, monkeypatch):
    """A user without a home, as in a container under a foreign number."""
    for name in ("BLADERUB_CACHE", "XDG_CACHE_HOME"):
        monkeypatch.delenv(name, raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "nonexistent"))
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    return tmp_path / f"bladerub-{os.getuid()}"


def test_a_user_without_a_home_keeps_things_where_nobody_else_writes(homeless):
    assert cache_folder() == homeless
    assert homeless.stat().st_mode & 0o777 == 0o700
    assert cache_folder() == homeless


def test_a_folder_that_others_can_write_is_refused(homeless):
    homeless.mkdir()
    homeless.chmod(0o777)
    with pytest.raises(OSError, match="BLADERUB_CACHE"):
        cache_folder()


@pytest.mark.parametrize("name", ["BLADERUB_CACHE", "XDG_CACHE_HOME"])
def test_a_folder_that_is_named_is_used(homeless, tmp_path, monkeypatch, name):
    monkeypatch.setenv(name, str(tmp_path / "named"))
    assert cache_folder().is_relative_to(tmp_path / "named")
