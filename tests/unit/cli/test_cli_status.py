import json

import pytest

from bladerub.cli import inputs, main
from bladerub.extras.chart.point import PointRow
from bladerub.io import hdf5
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


def test_a_blade_of_another_config_makes_every_run_stale(small, tmp_path, capsys):
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


@pytest.fixture
def files(tmp_path):
    """A run, a longer run and a point of the chart, each with one that is whole, and their manifests."""
    runs, chart = tmp_path / "results" / "runs" / "2nd_E2_K0.5_theta0", tmp_path / "results" / "chart"
    names = ["0.2000.h5", "0.3000.h5", "confirmation/0.2000.h5", "confirmation/0.3000.h5"]
    paths = [runs / name for name in names] + [chart / "cells" / name for name in ("a.h5", "b.h5")]
    for path in paths:
        hdf5.write(path, {}, {"run_key": path.name})
    sums = [file_checksum(path) for path in paths]
    sizes = [path.stat().st_size for path in paths]
    rows = [
        ManifestRow(name, 0.2, "a", "completed", sizes[index], "b", sizes[index + 2], *sums[index:4:2])
        for index, name in enumerate(names[:2])
    ]
    write_manifest(runs / "manifest.tsv", rows)
    points = [PointRow("a.h5", "c", sizes[4], sums[4]), PointRow("b.h5", "d", sizes[5], sums[5])]
    write_manifest(chart / "columns" / "2nd_E2_theta0.tsv", points, PointRow)
    return paths


def test_every_kind_of_damaged_file_is_named_and_deleted_on_request(small, files, capsys):
    hurt = files[1::2]
    for path in hurt:
        path.write_text(path.name.replace("h", "i"))
    main(["status", "--thorough", "--json", *small])
    printed = json.loads(capsys.readouterr().out)
    assert set(map(str, hurt)) <= set(printed["damaged"])
    assert not {str(files[2]), str(files[4])} & set(printed["damaged"])
    assert not printed["discarded"]
    assert all(path.exists() for path in files)
    assert main(["status", "--thorough", "--discard", *small]) == 0
    assert all(str(path) in capsys.readouterr().out for path in hurt[:1])
    assert not any(path.exists() for path in hurt)
    assert files[2].exists()
    assert files[4].exists()
