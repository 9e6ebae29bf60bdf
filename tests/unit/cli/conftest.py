import pytest

from bladerub.config import record
from bladerub.io.folders import ROOT


@pytest.fixture(autouse=True)
def without_a_study(monkeypatch):
    """Leave out what made the results that this clone may hold: commands would read their config."""
    read = record.read
    monkeypatch.setattr(
        record, "read", lambda results: None if results.is_relative_to(ROOT) else read(results)
    )
