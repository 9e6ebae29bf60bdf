import csv
import json

import pandas as pd
import pytest

from bladerub import plugins
from bladerub.io import tables
from bladerub.io.errors import BadInput, DamagedFile
from bladerub.io.folders import ROOT

ORIGIN = {"provenance_software": "bladerüb 1", "provenance_git_commit": "abc"}


@pytest.fixture
def table():
    return pd.DataFrame({"casing": ["2nd", "2nd"], "amplitude": [1 / 3, float("nan")]}, index=[5, 7])


def test_the_table_is_plain_csv(table, tmp_path):
    path = tmp_path / "new" / "peaks.csv"
    tables.write(path, table, ORIGIN, "%.3g")
    assert path.read_text() == "casing,amplitude\n2nd,0.333\n2nd,\n"
    assert tables.read(path, ["casing"]).fillna(0.0).to_numpy().tolist() == [["2nd", 0.333], ["2nd", 0.0]]


def test_infinite_numbers_are_as_the_w3c_has_them(table, tmp_path):
    table = table.assign(E=[float("inf"), float("-inf")], K=float("inf"))
    tables.write(path := tmp_path / "peaks.csv", table, ORIGIN)
    cells = [line.split(",")[2:] for line in path.read_text().splitlines()[1:]]
    assert cells == [["INF", "INF"], ["-INF", "INF"]]
    assert tables.read(path).E.tolist() == [float("inf"), float("-inf")]


def test_the_description_has_units_datatypes_and_origin(table, tmp_path):
    tables.write(tmp_path / "peaks.csv", table, ORIGIN)
    text = (tmp_path / "peaks.csv-metadata.json").read_text(encoding="utf-8")
    about = json.loads(text)
    assert "bladerüb" in text
    assert about["url"] == "peaks.csv"
    output = {entry["schema:name"]: entry["schema:value"] for entry in about["dc:provenance"]}
    assert output == ORIGIN
    casing, amplitude = about["tableSchema"]["columns"]
    assert (casing["name"], casing["datatype"], "schema:unitText" in casing) == ("casing", "string", False)
    assert (amplitude["datatype"], amplitude["schema:unitText"]) == ("number", "m")


def test_a_copy_brings_its_description_and_the_origin_is_that_of_the_file_now(table, tmp_path):
    source, target = tmp_path / "a" / "peaks.csv", tmp_path / "longer_peaks.csv"
    for origin in (ORIGIN, ORIGIN | {"provenance_git_commit": "def"}):
        tables.write(source, table, origin)
        tables.copy(source, target)
        assert target.read_bytes() == source.read_bytes()
        assert tables.read_origin(source) == tables.read_origin(target) == origin
        tables.check(target)
        assert json.loads(tables.description_path(target).read_text())["url"] == "longer_peaks.csv"


def test_every_column_is_described_once_with_datatype_and_unit():
    files = [tables.COLUMNS_FILE, *plugins.files("columns.csv"), *ROOT.glob("studies/*/columns.csv")]
    rows = [row for file in files for row in csv.reader(file.read_text(encoding="utf-8").splitlines()[1:])]
    assert len({name for name, *_ in rows}) == len({tuple(row) for row in rows})
    for name, datatype, unit, description in rows:
        assert description, name
        assert {"string": "", "boolean": "", "integer": "1", "number": unit}[datatype] == unit, name


def test_a_column_that_nobody_described_is_refused_before_anything_is_written(table, tmp_path):
    with pytest.raises(ValueError, match=r"peaks\.csv: columns not described: depth; describe them in "):
        tables.write(tmp_path / "peaks.csv", table.assign(depth=1), ORIGIN)
    assert not list(tmp_path.iterdir())


def test_a_wrong_line_of_descriptions_is_named(tmp_path):
    (columns := tmp_path / "columns.csv").write_text("column,datatype,unit,description\na,m2,number,b\n")
    with pytest.raises(BadInput, match=r"columns\.csv:2: a,m2,number,b: must be column, "):
        tables.described_columns(columns)


def test_what_is_not_the_whole_table_is_named(tmp_path, table):
    path = tmp_path / "table.csv"
    path.write_text("E\tamplitude\n1\t2\n")
    assert tables.read(path, ["E"], "\t").amplitude.tolist() == [2]
    for content, words in (
        ("E,amp", "not a whole table"),
        ("K,amplitude\n1,2\n", "not the right table, E"),
        ("E,amplitude\n1,2\n1,2,3\n", "not a table"),
    ):
        path.write_text(content)
        with pytest.raises(DamagedFile, match=rf"table\.csv: {words}"):
            tables.read(path, ["E", "amplitude"])
    tables.write(path, table, ORIGIN)
    path.write_text(path.read_text().replace("0.33", "0.43"))
    with pytest.raises(DamagedFile, match=r"table\.csv: not as it was written"):
        tables.read(path)
