import json

import pytest

from bladerub.cli import inputs, main

COUNTS = {
    "planned",
    "done",
    "missing",
    "stale",
    "corrupt",
    "unbounded",
    "longer_planned",
    "longer_done",
    "bytes",
}
SMALL = """
blade: {mesh: {chordwise: 7, thickness: 1, spanwise: 6}}
reduction: {accuracy_speeds: 3}
coatings: [{casing: 2nd, E: [2, 20], K: [0.5], theta: [0.0]}]
speeds: {start: 0.2, stop: 0.4, step: 0.1, extra: []}
analysis: {histories: []}
"""


@pytest.fixture
def small(tmp_path, monkeypatch):
    monkeypatch.setattr(inputs, "ROOT", tmp_path)
    overlay = tmp_path / "small.yaml"
    overlay.write_text(SMALL)
    return ["--config", str(overlay)]


def test_counts_as_json(small, capsys):
    assert main(["status", "--json", *small]) == 0
    output = capsys.readouterr()
    told = json.loads(output.out)
    coatings, note, damaged = told.pop("coatings"), told.pop("note"), told.pop("damaged")
    assert damaged == []
    assert told.keys() == COUNTS
    assert (told["planned"], told["missing"], told["done"]) == (6, 6, 0)
    assert coatings.keys() == {"2nd_E2_K0.5_theta0", "2nd_E20_K0.5_theta0"}
    assert all(each.keys() == COUNTS and each["planned"] == 3 for each in coatings.values())
    assert "reduced_model.h5" in note
    assert output.err == ""


def test_counts_in_words(small, capsys):
    assert main(["status", *small]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == [
        "coating",
        "planned",
        "done",
        "missing",
        "stale",
        "corrupt",
        "unbounded",
        "MB",
    ]
    assert lines[1].split() == ["2nd_E2_K0.5_theta0", "3", "0", "3", "0", "0", "0", "0.0"]
    assert lines[3].split()[:2] == ["all", "6"]
    assert "0 of 0 done" in lines[5]


def test_a_blade_of_another_config_makes_every_run_stale(small, tmp_path, capsys):
    overlay = tmp_path / "small.yaml"
    one = ["run", "--casing", "2nd", "--E", "2", "--K", "0.5", "--f", "0.2", "--revolutions", "2"]
    folder = tmp_path / "results" / "runs" / "2nd_E2_K0.5_theta0"
    assert main([*one, "--output", str(folder / "0.2000.h5"), *small]) == 0  # builds the blade
    overlay.write_text(SMALL.replace("spanwise: 6", "spanwise: 7"))
    capsys.readouterr()
    assert main(["status", "--json", *small]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["stale"], told["missing"]) == (1, 5)
    assert "the blade is of another config" in told["note"]


def test_nothing_is_written(small, tmp_path, capsys):
    main(["status", *small])
    assert [path.name for path in tmp_path.iterdir()] == ["small.yaml"]


def test_a_bad_config_is_refused(small, tmp_path, capsys):
    bad = tmp_path / "bad.yaml"
    bad.write_text("speeds: {step: -1}\n")
    assert main(["status", *small, "--config", str(bad)]) == 2
    output = capsys.readouterr()
    assert output.out == ""
    assert output.err.startswith(f"{bad}:1: speeds.step = -1")
