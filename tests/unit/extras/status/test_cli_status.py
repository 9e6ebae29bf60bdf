import io
import sys

import pytest

from bladerub.io.checksum import file_checksum
from bladerub.study.job import RunDone
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.workflow.job import JobProgress


@pytest.fixture
def folder(tmp_path):
    return tmp_path


def test_counts_as_json(six_runs, figures):
    printed = figures("status", *six_runs)
    coatings, note = printed.pop("coatings"), printed.pop("note")
    assert [printed.pop(name) for name in ("damaged", "lost", "cannot_be_read")] == [[], [], []]
    assert not printed.pop("discarded")
    assert (printed["planned"], printed["missing"], printed["done"]) == (6, 6, 0)
    assert coatings.keys() == {"2nd_E2_K0.5_theta0.15", "2nd_E20_K0.5_theta0.15"}
    assert all(each["planned"] == 3 for each in coatings.values())
    assert "reduced_model.h5" in note


def test_stale_runs_are_counted_and_damaged_ones_named_and_deleted_on_request(
    six_runs, command, figures, tmp_path
):
    one = ["run", "--casing", "2nd", "--E", "2", "--K", "0.5", "--theta", "0.15", "--f", "0.2"]
    folder = tmp_path / "results" / "runs" / "2nd_E2_K0.5_theta0.15"
    assert command(*one, *six_runs, "--output", folder / "0.2000.h5")[0] == 0  # builds the blade
    assert " rpm" in command("status", *six_runs)[1]  # by the blade of the results
    overlay = tmp_path / "six.yaml"
    overlay.write_text(overlay.read_text().replace("spanwise: 6", "spanwise: 7"))
    printed = figures("status", *six_runs)
    assert (printed["stale"], printed["missing"]) == (1, 5)
    assert "the blade is of another config" in printed["note"]
    hurt, whole = [folder / "0.2000.h5", folder / "confirmation" / "0.2000.h5"], folder / "0.3000.h5"
    hurt.append(tmp_path / "results" / "blade" / "mesh.h5")
    hurt[1].parent.mkdir()
    for path in (hurt[1], whole):
        path.write_bytes(hurt[0].read_bytes())
    for path in hurt:
        path.write_bytes(path.read_bytes()[:-8])
    sizes = [path.stat().st_size for path in (hurt[0], hurt[1], whole)]
    rows = [ManifestRow("0.2000.h5", 0.2, "a", "completed", sizes[0], "b", sizes[1], "c", "d")]
    rows.append(ManifestRow("0.3000.h5", 0.3, "e", "completed", sizes[2], checksum=file_checksum(whole)))
    write_manifest(folder / "manifest.tsv", rows)
    printed = figures("status", "--thorough", *six_runs)
    assert set(printed["damaged"]) == set(map(str, hurt))
    assert all(path.exists() for path in hurt)
    assert command("status", "--thorough", "--discard", *six_runs)[0] == 0
    assert not any(path.exists() for path in hurt)
    assert whole.exists()


@pytest.mark.parametrize("is_terminal", [True, False])
def test_each_run_is_a_line_of_the_log_and_the_bar_is_on_a_terminal_only(
    tmp_path, monkeypatch, capsys, is_terminal
):
    stream, run = io.StringIO(), RunDone(1, 1, "0.1000.h5", "completed", 0.1, 0.2)
    stream.isatty = lambda: is_terminal
    monkeypatch.setattr(sys, "__stderr__", stream)
    progress = JobProgress("2nd_E2_K0.5_theta0", tmp_path / "runs")
    progress(run)
    progress.finish([])
    assert capsys.readouterr().err.splitlines()[0] == str(run)
    assert ("2nd_E2_K0.5_theta0" in stream.getvalue()) == bool(stream.getvalue()) == is_terminal
