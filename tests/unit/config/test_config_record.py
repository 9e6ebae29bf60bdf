from pathlib import Path

import pytest

from bladerub.config import record
from bladerub.config.record import Record


def test_what_was_laid_over_the_config_comes_back(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    files = [Path("config/config.yaml"), tmp_path / "config" / "quick.yaml", Path("/elsewhere/own.yaml")]
    record.write("results", files, {"results": "results"})
    found = record.read(tmp_path / "results")
    assert found == Record(["config/quick.yaml", "/elsewhere/own.yaml"], {"results": "results"})
    assert str(found) == "--config config/quick.yaml /elsewhere/own.yaml results=results"


def test_nothing_was_laid_over(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    record.write("results", ["config/config.yaml"], {})
    assert record.read(tmp_path / "results") is None


@pytest.mark.parametrize("text", ["", "{}", "[1]", '{"files": 1}', '{"files": [], "command_line": [1]}'])
def test_a_damaged_record_is_none(tmp_path, text):
    (tmp_path / record.FILE).write_text(text)
    assert record.read(tmp_path) is None
