import itertools
import json
import re
from xml.etree import ElementTree

import numpy as np
import pandas as pd
import pytest
import yaml
from study_fixtures import changed

from bladerub import plugins
from bladerub.cli import inputs, main
from bladerub.io import hdf5, tables
from bladerub.io.provenance import provenance
from bladerub.study import divergence, peak_table
from bladerub.study.grid import coating_cases
from bladerub.study.maps import write_map

F1 = 192.0
OVERLAY = {
    "coatings": [
        {"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]},
        {"casing": "2nd", "coating": "rigid", "friction": [0.0], "damping_ratio": [0.001]},
    ],
    "speeds": {"start": 0.02, "stop": 0.4, "step": 0.01, "extra": []},
    "analysis": {"histories": []},
    "ensemble": {"members": 0},
}
STRAIGHT, INCLINED, RIGID = "2nd_E2_K0.5_theta0", "2nd_E2_K0.5_theta0.15", "2nd_rigid_mu0_xi0.001"


def tables_of(text):
    """Give the tables of a page by the first two words of their captions: texts by column for each row."""
    found = {}
    for part in re.findall("<table>.*?</table>", text, re.S):
        table = ElementTree.fromstring(part)
        head, *rows = [[cell.text for cell in row] for row in table.iter("tr")]
        caption = " ".join(table.findtext("caption/span").split()[:2])
        found[caption] = [dict(zip(head, row, strict=True)) for row in rows]
    return found


@pytest.fixture
def study(config, make_map, tmp_path, monkeypatch):
    """Three coatings: the first is the worst, diverges from 0.3 on and is unbounded at the last speed."""
    config = changed(config, **OVERLAY)
    cases = {case.name: case for case in coating_cases(config)}
    growth = np.where(np.round(np.arange(0.02, 0.4001, 0.01), 6) >= 0.3, 0.05, 0.0)
    status = np.where(growth.cumsum() > 0.52, "unbounded", "completed")
    maps = [
        make_map(cases[STRAIGHT], {4: (0.29, 3e-3), 6: (0.18, 1e-3)}, growth=growth, status=status),
        make_map(cases[INCLINED], {4: (0.28, 5e-4), 6: (0.17, 2e-4), 9: (0.1, 4e-3)}),
        make_map(cases[RIGID], {4: (0.31, 1e-3), 6: (0.19, 9e-4)}),
    ]
    folder, origin = tmp_path / "results", provenance(config.plain())
    hdf5.write(folder / "blade" / "reduced_model.h5", {}, {"f1_hz": F1})
    for coating in maps:
        write_map(folder / "maps" / f"{coating.case.name}.h5", coating, origin)
    accuracy = pd.DataFrame(itertools.product((0.0, 0.2, 0.4), range(1, 8)), columns=["f_omega", "mode"])
    f_fe = F1 * accuracy["mode"] * np.sqrt(1 + 3 * accuracy.f_omega**2)
    accuracy = accuracy.assign(f_fe=f_fe, f_fe_eq2=1.02 * f_fe, f_rom=f_fe, relative_error=0.0)
    choice = {"E": 2.0, "K": 0.1, "theta": 0.15, "safe": True, "peak": 4e-4, "safe_neighbours": 2}
    choice |= {"neighbours": 5, "lowest_neighbour": 3e-4, "highest_neighbour": 9e-4}
    frames = {
        "chart_choice": pd.DataFrame([choice | {"safe_coatings": 7, "coatings": 40}]),
        "peaks": peak_table.table(config, maps),
        "divergence": divergence.table(config, maps),
        "campbell": accuracy[["f_omega", "mode", "f_fe", "f_rom"]],
        "rom_accuracy": accuracy,
    }
    for name, frame in frames.items():
        tables.write(folder / f"tables/{name}.csv", frame, origin, None, plugins.files("columns.csv"))
    monkeypatch.setattr(inputs, "study_folder", lambda: tmp_path)
    (tmp_path / "small.yaml").write_text(yaml.safe_dump(OVERLAY))
    return folder


@pytest.fixture
def report(study, capsys):
    def call(*options):
        code = main(["report", "--config", str(study.parent / "small.yaml"), *options])
        return code, capsys.readouterr()

    return call


def test_a_page_whole_by_itself_has_the_numbers_of_the_tables_with_units(study, report):
    assert report("--coating", STRAIGHT)[0] == 0
    page = (study / "report.html").read_text(encoding="utf-8")
    assert not re.search(r"<script|<link |src=\"(?!data:)|url\((?!#)", page)
    assert all(f'id="{anchor}"' in page for anchor in re.findall(r'<a href="#([\w-]+)"', page))
    peaks, shown_tables = tables.read(study / "tables" / "peaks.csv"), tables_of(page)
    rows = shown_tables["Peak of"]
    assert [row["coating"] for row in rows] == [*2 * [STRAIGHT], *2 * [RIGID], *2 * [INCLINED]]
    shown = {(row["coating"], int(row["engine order"])): row for row in rows}
    names = {0.0: STRAIGHT, 0.15: INCLINED}
    for peak in peaks[np.isfinite(peaks.E)].itertuples():
        row = shown[names[peak.theta], peak.order]
        assert row["amplitude (mm)"] == f"{1e3 * peak.amplitude:.3g}"
        assert row["speed (rpm)"] == f"{60 * F1 * peak.f_peak:,.0f}"
    runs = tables.read(study / "tables" / "divergence.csv").query("theta == 0 and E < 100")
    worst = shown_tables["Coatings side"][0]
    assert worst["diverging speeds (%)"] == f"{100 * runs.divergent.mean():.2g}" != "0"
    assert (worst["coating"], worst["E"], worst["K"]) == (STRAIGHT, "1.2 GPa", "300 MPa")
    first = 60 * F1 * runs[runs.divergent].f_omega.min()
    assert worst["diverges at (rpm)"] == f"{first:,.0f} to 4,608"
    assert "4 mm at 1,152 rpm on order 9" in page  # more than at its peaks
    (change,), (choice,) = shown_tables["One property"], shown_tables["Recommended by"]
    assert change["highest peak (mm)"] == "3 → 0.5"
    assert (choice["displacement (mm)"], choice["safe in the chart"]) == ("0.4", "7 of 40")
    assert shown_tables["Runs to"][0]["ended at the displacement limit (runs)"] == "1"


def test_coatings_are_chosen_by_name_and_a_study_that_is_not_finished_is_refused(study, report, tmp_path):
    assert report("--coating", "2nd")[0] == 2
    code, output = report("--json", "--coating", RIGID, "-o", str(tmp_path / "page.html"))
    assert (code, json.loads(output.out)["coatings"][0]) == (0, STRAIGHT)
    assert (tmp_path / "page.html").read_text(encoding="utf-8").count("<img ") == 2
    (study / "tables" / "peaks.csv").unlink()
    code, output = report("--json")
    assert (code, output.err.count("\n")) == (2, 1)
    assert "results/tables/peaks.csv is missing" in output.err
