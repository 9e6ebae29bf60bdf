"""Changing the study and changing it back costs no run."""

import pytest

from bladerub.study import archive
from bladerub.study.archive import SHELF, unshelve


def test_a_stale_run_is_found_again_when_its_study_returns(compute, simulated, tmp_path):
    before = {path.name: path.read_bytes() for path in tmp_path.glob("*.h5")}
    assert not before
    first = compute()
    files = {row.file: (tmp_path / row.file).read_bytes() for row in first}
    n = len(simulated)
    compute(digest="another blade")
    assert len(simulated) == 2 * n
    assert compute() == first
    assert len(simulated) == 2 * n
    assert {row.file: (tmp_path / row.file).read_bytes() for row in first} == files


def test_the_shelf_may_be_deleted(compute, simulated, tmp_path):
    first = compute()
    compute(digest="another blade")
    for path in (tmp_path / SHELF).iterdir():
        path.unlink()
    n = len(simulated)
    assert compute() == first
    assert len(simulated) == n + len(first)


def test_a_damaged_run_on_the_shelf_is_not_taken(compute, simulated, tmp_path):
    first = compute()
    compute(digest="another blade")
    shelved = tmp_path / SHELF / f"{first[0].run_key}.h5"
    shelved.write_bytes(shelved.read_bytes()[:1000])
    assert not unshelve(tmp_path / first[0].file, first[0].run_key)


@pytest.mark.parametrize("error", [OSError, RuntimeError, KeyError])  # h5py raises any of them
def test_a_damaged_run_is_written_anew_whatever_is_wrong_with_it(compute, simulated, monkeypatch, error):
    def broken(path):
        raise error

    monkeypatch.setattr(archive, "read_run", broken)
    assert len(compute()) == 4
