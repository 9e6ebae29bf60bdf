import json

import pytest

from bladerub.cli import inputs, main
from bladerub.io.checksum import file_checksum
from bladerub.study.manifest import ManifestRow, write_manifest

SMALL = """
blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 6}}
reduction: {accuracy_speeds: 3}
coatings: [{casing: 2nd, E: [2, 20], K: [0.5], theta: [0.0]}]
speeds: {start: 0.2, stop: 0.4, step: 0.1, extra: []}
analysis: {histories: []}
"""


@pytest.fixture
def small(tmp_path, monkeypatch):
    monkeypatch.setattr(inputs, "study_folder", lambda: tmp_path)
    overlay = tmp_path / "small.yaml"
    overlay.write_text(SMALL)
    return ["--config", str(overlay)]


def test_counts_as_json(small, capsys):
    assert main(["status", "--json", *small]) == 0
    output = capsys.readouterr()
    printed = json.loads(output.out)
    coatings, note = printed.pop("coatings"), printed.pop("note")
    assert [printed.pop(name) for name in ("damaged", "lost", "cannot_be_read")] == [[], [], []]
    assert not printed.pop("discarded")
    assert (printed["planned"], printed["missing"], printed["done"]) == (6, 6, 0)
    assert coatings.keys() == {"2nd_E2_K0.5_theta0", "2nd_E20_K0.5_theta0"}
    assert all(each["planned"] == 3 for each in coatings.values())
    assert "reduced_model.h5" in note
    assert output.err == ""


def test_stale_runs_are_counted_and_damaged_ones_named_and_deleted_on_request(small, tmp_path, capsys):
    overlay = tmp_path / "small.yaml"
    one = ["run", "--casing", "2nd", "--E", "2", "--K", "0.5", "--f", "0.2", "--revolutions", "2"]
    folder = tmp_path / "results" / "runs" / "2nd_E2_K0.5_theta0"
    assert main([*one, "--output", str(folder / "0.2000.h5"), *small]) == 0  # builds the blade
    overlay.write_text(SMALL.replace("spanwise: 6", "spanwise: 7"))
    capsys.readouterr()
    assert main(["status", "--json", *small]) == 0
    printed = json.loads(capsys.readouterr().out)
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
    assert main(["status", "--thorough", "--json", *small]) == 0
    printed = json.loads(capsys.readouterr().out)
    assert set(printed["damaged"]) == set(map(str, hurt))
    assert not printed["discarded"]
    assert main(["status", "--thorough", "--discard", *small]) == 0
    assert not any(path.exists() for path in hurt)
    assert whole.exists()
