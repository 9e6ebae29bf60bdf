import pandas as pd

from bladerub.io import tables
from docs import snapshots

ORIGIN = {"version": "1"}


def taken(tmp_path, name, table):
    source, target = tmp_path / f"{name}.csv", tmp_path / "taken" / f"{name}.csv"
    target.parent.mkdir()
    tables.write(source, table, ORIGIN)
    snapshots.take(source, target)
    assert tables.read_origin(target) == ORIGIN
    return source, target


def test_runs_with_equal_outcome_are_counted(tmp_path):
    columns = [*snapshots.COUNTED["long_runs"], "f_omega"]
    rows = [("theta", "f4", 500, "free", f_omega) for f_omega in (0.1, 0.2)]
    rows += [("theta", "f4", 500, "steady", 0.3)]
    _, target = taken(tmp_path, "long_runs", pd.DataFrame(rows, columns=columns))
    counts = tables.read(target)
    assert list(counts.columns) == [*snapshots.COUNTED["long_runs"], "runs"]
    assert dict(zip(counts.verdict, counts.runs, strict=True)) == {"free": 2, "steady": 1}


def test_quoted_columns_are_kept_to_four_digits(tmp_path):
    columns = [*snapshots.KEPT["calibration"], "claim"]
    table = pd.DataFrame([("start", "C1a", 0.123456, "yes", "modes agree")], columns=columns)
    _, target = taken(tmp_path, "calibration", table)
    kept = {"set": "start", "id": "C1a", "measured": 0.1235, "holds": "yes"}
    assert tables.read(target).to_dict("records") == [kept]


def test_an_equal_snapshot_keeps_its_description(tmp_path):
    folder, made = tmp_path / "data", tmp_path / "results" / "tables"
    folder.mkdir()
    made.mkdir(parents=True)
    for name, value in (("findings", "no"), ("margins", "yes")):
        tables.write(folder / f"{name}.csv", pd.DataFrame({"holds": ["yes"]}), ORIGIN)
        tables.write(made / f"{name}.csv", pd.DataFrame({"holds": [value]}), {"version": "2"})
    snapshots.update(folder, tmp_path / "results")
    assert tables.read(folder / "findings.csv")["holds"].tolist() == ["no"]
    assert tables.read_origin(folder / "findings.csv") == {"version": "2"}
    assert tables.read_origin(folder / "margins.csv") == ORIGIN
