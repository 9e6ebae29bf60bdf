"""A study of one's own: one folder, a repository or module, a blade from a file; and those that are there."""

import json
import re
import zipfile

import numpy as np
import pandas as pd
import pytest
import yaml
from workspace import ROOT, Workspace

from bladerub.blade.build import meshed_blade
from bladerub.config.read import read
from bladerub.extras.export.mesh_file import write_mesh_file
from bladerub.io import hdf5, tables
from bladerub.settings.blade import Mesh
from bladerub.study.store import read_run

FILES = {
    "rules.smk": """
rule own:
    output:
        **drawn("own", "Of my own"),
        **described(table=f"{TABLES}/own.csv"),
    params:
        dpi=DPI,
    script:
        "scripts/own.py"
""",
    "scripts/own.py": """
import pandas as pd

from bladerub.plots import style
from bladerub.workflow import outputs

outputs.save(snakemake, style.new_figure(2, 1), table=pd.DataFrame({"own": [1.0]}))
""",
    "report/own.rst": "Nothing but a frame\n",
    "columns.csv": "column,datatype,unit,description\nown,number,m,of this study alone\n",
}


def test_a_folder_is_all_that_a_study_needs(workspace, tiny):
    for name, text in FILES.items():
        path = workspace.folder / "studies" / "own" / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    workspace.build(tiny, "own")
    assert (workspace.results / "figures" / "own.png").is_file()
    table = workspace.results / "tables" / "own.csv"
    assert tables.read(table)["own"].tolist() == [1.0]
    assert "of this study alone" in tables.description_path(table).read_text(encoding="utf-8")


def test_the_crate_holds_the_workflow_and_what_it_made_and_reports_are_pages_of_their_own(copied_study, tiny):
    copied_study.build(tiny, "crate")
    with zipfile.ZipFile(copied_study.results / "study.crate.zip") as archive:
        names, metadata = archive.namelist(), json.loads(archive.read("ro-crate-metadata.json"))
    entities = {entity["@id"]: entity for entity in metadata["@graph"]}
    workflow = entities[entities["./"]["mainEntity"]["@id"]]
    assert "ComputationalWorkflow" in workflow["@type"]
    assert entities["#provenance_software"]["value"].startswith("bladerub ")
    assert {part["@id"] for part in entities["./"]["hasPart"]} <= entities.keys()
    assert {"Snakefile", "config/config.yaml", "results/tables/findings.csv"} <= set(names)
    assert "results/maps/2nd_E2_K0.5_theta0.15.h5" in names
    copied_study.said("bladerub", "report")
    page = (copied_study.results / "report.html").read_text(encoding="utf-8")
    worst = tables.read(copied_study.results / "tables" / "peaks.csv").nlargest(1, "amplitude").iloc[0]
    assert f"{1e3 * worst.amplitude:.3g} mm at {worst.f_peak_rpm:,.0f} rpm" in page
    assert 'href="explorer.html"' in page
    assert len(page) < 5e6
    done = copied_study.snakemake("--report", "report.html", config=tiny)
    assert done.returncode == 0, done.stderr
    page = (copied_study.folder / "report.html").read_text(encoding="utf-8")
    assert {"fig08_spectrum_soft.png", "findings.csv"} <= set(re.findall(r"[\w.]+", page))
    # nothing is loaded from elsewhere
    assert re.findall(r"<(?:script|link|img)[^>]+(?:src|href)=\"(?:https?:)?//[^\"]+", page) == []


def test_both_laws_are_compared_and_each_peak_has_its_stress_when_asked_for(copied_study, tiny):
    tiny["friction"] = [{"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.15]}]
    plan = copied_study.plan(tiny, "friction")
    assert plan == {"coating": 1, "friction": 1}  # the one with theta is of the study
    copied_study.build(tiny, "friction")
    table = pd.read_csv(copied_study.results / "tables" / "friction.csv")
    assert list(table.f_omega) == [0.15, 0.19, 0.197, 0.206, 0.23, 0.27, 0.31, 0.35]
    assert (table.reversed_coulomb == 0).all()
    assert table.difference.abs().max() < 1e-6
    assert (table.peak_theta > 0).all()

    assert copied_study.plan(tiny, "stress") == {"stress": 1}
    copied_study.build(tiny, "stress")
    peaks = tables.read(copied_study.results / "tables" / "peaks.csv")
    stress = tables.read(copied_study.results / "tables" / "stress.csv")
    assert stress.f_peak.tolist() == peaks.f_peak.dropna().tolist()
    assert (stress.rotation_von_mises > 0).all()
    assert (stress.last_von_mises > stress.rotation_von_mises).all()
    assert copied_study.plan(tiny, "stress") == {}
    assert copied_study.plan(tiny) == {}  # and the study has no part in them


@pytest.fixture
def beside(tiny):
    coatings = ["2nd_E1.1_K0.5_theta0", "2nd_rigid_mu0", "2nd_E7_K0.5_theta0"]
    sweeps = {"coatings": coatings, "start": 0.16, "stop": 0.34, "rates": [1.0, 2.0]}
    return tiny | {"sweeps": sweeps | {"speed_step": 2e-3}, "long_runs": {"revolutions": 12}}


def test_sweeps_and_long_runs_are_planned(study, beside):
    plan = study.plan(beside, "sweeps", "long_runs")
    assert plan == {"sweep": 8, "sweeps": 1, "long_coating": 6, "long_runs": 1}


@pytest.mark.nightly
def test_sweeps_and_long_runs_are_made_when_asked_for(copied_study, beside):
    copied_study.build(beside, "sweeps", "long_runs")
    table = pd.read_csv(copied_study.results / "tables" / "sweeps.csv")
    assert len(table) == 2 * 2 * 2 * 2  # coatings, directions, rates, engine orders
    assert (table.energy_residual < 1e-3).all()

    long = pd.read_csv(copied_study.results / "tables" / "long_runs.csv")
    assert set(long.revolutions) == {3, 6, 12}
    data, _ = hdf5.read(copied_study.results / "long_runs" / "2nd_E1.1_K0.5_theta0.h5")
    for f_omega, amplitude in zip(data["f_omega"], data["revolution_amplitude"], strict=True):
        run = copied_study.results / "runs" / "2nd_E1.1_K0.5_theta0" / f"{f_omega:.4f}.h5"
        np.testing.assert_array_equal(hdf5.read(run)[0]["revolution_amplitude"], amplitude[:3])

    assert copied_study.plan(beside, "sweeps", "long_runs") == {}
    beside["sweeps"]["rates"] = [1.0, 3.0]
    assert copied_study.plan(beside, "sweeps") == {"sweep": 4, "sweeps": 1}
    assert copied_study.plan(beside) == {}  # the study has no part in it


@pytest.mark.nightly
def test_the_chart_is_drawn_once_and_a_lost_cell_is_made_anew_alone(copied_study, tiny):
    charted = tiny | {"chart": {"E": [0.11, 2], "K": [0.5, 5], "theta": [0.0]}}
    copied_study.build(charted, "chart", "results/tables/chart_agreement.csv")
    chart = tables.read(copied_study.results / "tables" / "chart.csv")
    assert chart.runs.tolist() == [8] * 4
    # E = 0.11 and 2 with K = 0.5 are coatings of the study as well, at the same speeds
    agreement = tables.read(copied_study.results / "tables" / "chart_agreement.csv")
    assert len(agreement) == 2 * 3
    assert (agreement.in_chart == agreement.greatest).all()

    assert copied_study.plan(charted, "chart") == {}
    cells, lost = copied_study.results / "chart" / "cells", "2nd_E2_K5_theta0.h5"
    before = {path.name: path.stat().st_mtime_ns for path in cells.glob("*.h5")}
    (cells / lost).unlink()
    copied_study.build(charted, "results/chart/columns/2nd_E2_theta0.tsv")
    assert {name for name in before if (cells / name).stat().st_mtime_ns != before[name]} == {lost}


OWN_RULE = """

rule own:
    input:
        rules.coating.output.map.format(coating="2nd_E1.1_K0.5_theta0"),
    output:
        "results/own.txt",
    shell:
        "du -b {input} > {output}"
"""


def test_it_computes_its_own_config_and_takes_rules_of_ones_own(tmp_path, study, tiny):
    Workspace(tmp_path, study.sources).said("bladerub", "new", "own")
    own = Workspace(tmp_path / "own", study.sources)
    (own.folder / "small.yaml").write_text(yaml.safe_dump(tiny))
    with (own.folder / "Snakefile").open("a") as snakefile:
        snakefile.write(OWN_RULE)
    own.said("snakemake", "own", "-j2", "--configfile", "small.yaml")
    assert "2nd_E1.1_K0.5_theta0.h5" in (own.results / "own.txt").read_text()
    counts = Workspace(own.folder / "config", study.sources).said("bladerub", "status", "--json")
    assert json.loads(counts)["coatings"]["2nd_E1.1_K0.5_theta0"]["missing"] == 0
    assert "histograms" in own.said("snakemake", "-n", "--quiet", "rules", "--configfile", "small.yaml")


def test_the_study_of_the_guide_for_contributors_is_drawn(copied_study, tiny):
    guide = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for path, text in re.findall(r"`(studies/deepest/\S+)`:\n\n```\w+\n(.*?)```", guide, re.S):
        (copied_study.folder / path).parent.mkdir(parents=True, exist_ok=True)
        (copied_study.folder / path).write_text(text, encoding="utf-8")
    copied_study.sources = copied_study.folder / "src"  # studies are those beside them
    copied_study.build(tiny, "deepest")
    table = tables.read(copied_study.results / "tables" / "deepest.csv", ["f_omega", "max_wear"])
    assert (table.max_wear > 0).any()
    assert (copied_study.results / "figures" / "deepest.pdf").exists()


MODULE = """
configfile: "config/config.yaml"


module rub:
    snakefile:
        {snakefile!r}
    config:
        config["rub"]


use rule * from rub as rub_*
"""


def test_the_config_of_a_module_statement_is_that_of_the_study(tmp_path, study, tiny):
    tiny["coatings"] = [{"casing": "2nd", "E": [3], "K": [0.5], "theta": [0.0]}]
    (tmp_path / "Snakefile").write_text(MODULE.format(snakefile=str(ROOT / "Snakefile")))
    (tmp_path / "config").mkdir()
    content = {"samples": ["a"], "rub": {**tiny, "results": "results/rub"}}
    (tmp_path / "config" / "config.yaml").write_text(yaml.safe_dump(content))
    folder = tmp_path / "results" / "rub" / "runs" / "2nd_E3_K0.5_theta0"
    target = f"{folder.relative_to(tmp_path)}/manifest.tsv"
    workspace = Workspace(tmp_path, study.sources)
    plan = workspace.call("snakemake", "-n", target).stderr
    assert re.search(r"(\d+) of \1 runs of the study are to be computed", plan), plan[-500:]
    workspace.said("snakemake", "-j2", target)
    assert read_run(folder / "0.1500.h5").attributes["revolutions"] == tiny["solver"]["revolutions"]
    assert [path.parent for path in folder.parent.glob("*/manifest.tsv")] == [folder]


PICTURE = "results/figures/fig01_blade.png"


@pytest.fixture
def foreign(workspace, tiny):
    """Overlay of a study whose blade is the default one, in mm."""
    blade = read(workspace.folder / "config" / "config.yaml").blade
    mesh = meshed_blade(blade.replaced("mesh", Mesh(chordwise=7, thickness=1, spanwise=4))).mesh.mesh
    write_mesh_file(workspace.folder / "meshes" / "blade.msh", 1e3 * mesh.points, mesh.cells, {})
    tiny["blade"]["source"] = {"file": "meshes/blade.msh", "unit": "mm"}
    return tiny


def test_a_blade_from_a_file_is_made_and_drawn_and_made_anew_with_the_file(workspace, foreign):
    workspace.build(foreign, PICTURE)
    mesh, _ = hdf5.read(workspace.folder / "results" / "blade" / "mesh.h5")
    assert mesh["cells"].shape == (7 * 4, 20)
    assert workspace.plan(foreign, PICTURE) == {}
    file = workspace.folder / "meshes" / "blade.msh"
    file.write_bytes(file.read_bytes() + b"$Comments\nlonger\n$EndComments\n")
    assert workspace.plan(foreign, PICTURE) == {"blade": 1, "fig01_blade": 1}


def test_a_study_of_it_draws_wear_maps_casings_and_on_those_of_its_own_spectra(workspace, foreign):
    casing = read(workspace.folder / "config" / "config.yaml").casings["2nd"].plain()
    foreign["casings"] = {"own": casing | {"nodal_diameters": [3]}}
    entry = {"E": [2, 5], "K": [0.5], "theta": [0.0]}
    foreign["coatings"] = [{"casing": name} | entry for name in ("2nd", "own")]
    foreign["coatings"] += [{"casing": "own", "coating": "rigid", "friction": [0.0]}]
    plan = workspace.plan(foreign)
    assert (plan["coating"], plan["spectrum"], plan["casing"]) == (5, 5, 2)
    assert plan["wear_map"] == 4  # the rigid casing does not wear
    assert not {"findings", "margins"} & plan.keys()  # the paper speaks of another blade


def test_a_broken_file_ends_the_study_with_one_line(workspace, foreign):
    (workspace.folder / "meshes" / "blade.msh").write_text("$MeshFormat\n")
    said = workspace.failure(PICTURE, "--cores", "1", config=foreign)
    assert said.count("meshes/blade.msh: does not end with") == 1
    assert not (workspace.folder / "results" / "blade").exists()
