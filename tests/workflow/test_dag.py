"""What the real workflow plans, computes and refuses, on a tiny study."""

import re
import shutil
import subprocess
from itertools import pairwise
from pathlib import Path

import pytest
import yaml

from bladerub.contact import law

COATING = "2nd_E2_K0.5_theta0"
END = {"explorer": 1, "cost": 1, "all": 1}
PEAKS = {"peaks": 1, "findings": 1, "margins": 1, "fig10_peaks": 1, "histograms": 1} | END


def test_a_commit_plans_nothing(copied_study, tiny):
    copied_study.sources = copied_study.folder / "src"  # whose state git is to tell
    git = ["git", "-c", "user.name=t", "-c", "user.email=t@t", "-c", "commit.gpgsign=false"]
    for command in (["init", "-q"], ["add", "src"], ["commit", "-qm", "first"]):
        subprocess.run([*git, *command], cwd=copied_study.folder, check=True)
    assert copied_study.plan(tiny) == {}
    before = copied_study.runs()
    manifest = f"results/runs/{COATING}/manifest.tsv"
    (copied_study.folder / manifest).unlink()
    copied_study.build(tiny, manifest)
    assert copied_study.runs() == before


def test_one_figure_plans_only_what_it_needs_and_the_longest_runs_come_first(workspace, tiny):
    plan = workspace.plan(tiny, "results/figures/fig08_spectrum_soft.png")
    assert plan == {"blade": 1, "compile_kernel": 1, "coating": 1, "fig08_spectrum_soft": 1}
    planned = workspace.dry_run("all", config=tiny)
    found = re.findall(r"rule coating:.*?coating=(\S+)\s+priority: (\S+)", planned, re.DOTALL)
    priority = {coating: float(number) for coating, number in found}
    assert max(priority, key=priority.get) == "2nd_rigid_mu0", priority


def test_a_blade_that_snakemake_has_no_record_of_is_made_anew_for_another_config(copied_study, tiny):
    """As after `bladerub run`, whose blade once served the runs of a study of another config."""
    shutil.rmtree(copied_study.folder / ".snakemake")
    assert copied_study.plan(tiny) == {}
    tiny["blade"] = {**tiny["blade"], "length": 0.21}
    assert copied_study.plan(tiny)["blade"] == 1


def test_a_change_of_the_config_plans_what_comes_of_it(study, tiny):
    plan = study.plan(tiny | {"figures": {"amplitude_range": [1.0e-6, 1.0e-3]}})
    spectra = {"fig07", "fig08", "fig09", "fig10", "fig15", "fig16"}
    assert {name[:5] for name in plan} == spectra | {"explo", "cost", "all"}
    plan = study.plan(tiny | {"casings": {"2nd5nd": {"interference": 0.0003}}})
    assert plan["coating"] == 1
    assert "blade" not in plan
    analysis = tiny["analysis"] | {"peaks": {"speed_window": [0.9, 1.2]}}
    assert study.plan(tiny | {"analysis": analysis}) == PEAKS
    tiny["coatings"][2]["E"].append(3)
    tables = {"peaks": 1, "divergence": 1, "findings": 1, "margins": 1, "histograms": 1}
    assert study.plan(tiny) == {"coating": 2} | tables | END  # with both theta


def test_an_edit_of_the_sources_plans_what_comes_of_it(copied_study, tiny):
    copied_study.edit("study/peaks.py", '"""', '"""In short: ')
    assert copied_study.plan(tiny) == PEAKS
    copied_study.edit("contact/modes.py", '"""', '"""In short: ')
    plan = copied_study.plan(tiny)
    assert (plan["compile_kernel"], plan["coating"]) == (1, 6)
    assert "blade" not in plan


def test_a_dry_run_changes_nothing(copied_study, tiny):
    copied_study.plan(tiny)  # Snakemake lays out its folder
    runs = copied_study.results / "runs"
    (runs / "2nd_E1.1_K0.5_theta0" / "0.1970.h5").unlink()
    damaged = runs / "2nd_E2_K0.5_theta0" / "manifest.tsv"
    damaged.write_bytes(damaged.read_bytes()[:-9])
    for note in ("locks/0.output.lock", "claims/0.json"):  # of a Snakemake, and of ours, that was killed
        path = copied_study.folder / ".snakemake" / note
        path.parent.mkdir(exist_ok=True)
        path.write_text("results/tables/peaks.csv\n")

    def tree():
        paths = set(copied_study.folder.rglob("*")) - {*copied_study.folder.glob(".snakemake/iocache/*")}
        return {path: (path.lstat().st_ino, path.lstat().st_mtime_ns) for path in paths}

    (copied_study.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
    before = tree()
    planned = copied_study.dry_run("results/tables/peaks.csv", "--configfile", "overlay.yaml")
    assert tree() == before
    assert re.search(r"^coating +2$", planned, re.MULTILINE)


def halve_the_speed_step(config):
    config["speeds"]["step"] /= 2


def remove_an_E(config):
    config["coatings"][1]["E"].pop(0)


@pytest.mark.parametrize("edit", [pytest.param(halve_the_speed_step, marks=pytest.mark.nightly), remove_an_E])
def test_an_edit_computes_what_is_missing_or_stale_and_nothing_else(copied_study, tiny, edit):
    def to_do():
        counts = copied_study.status()
        return counts["missing"] + counts["stale"]

    target, study_runs = "results/tables/divergence.csv", "*/*.h5"  # without the longer runs
    edit(tiny)
    (copied_study.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))  # which the status reads
    planned, before = to_do(), copied_study.runs(study_runs)
    copied_study.build(tiny, target)
    now = copied_study.runs(study_runs)
    assert before.keys() <= now.keys()
    assert sum(before.get(name) != stamp for name, stamp in now.items()) == planned
    assert (planned == 0) == (edit is remove_an_E)
    assert any(now[name] == stamp for name, stamp in before.items())
    assert copied_study.plan(tiny, target) == {}
    assert to_do() == 0


def test_confirmation_computes_no_run_of_the_study(copied_study, tiny):
    manifest = f"results/runs/{COATING}/manifest.tsv"
    confirmation = tiny["analysis"]["divergence"]
    confirmation["confirmation_revolutions"] = 7
    assert copied_study.plan(tiny, manifest) == {"coating": 1}
    before = copied_study.runs("*/*.h5")
    copied_study.build(tiny, manifest)
    assert copied_study.runs("*/*.h5") == before
    confirmation["confirmation_revolutions"] = 0
    copied_study.build(tiny, manifest)
    confirmation["growth"] = 0.05
    assert copied_study.plan(tiny, manifest) == {}  # without confirmation it decides nothing


def test_a_failed_job_says_why_and_loses_no_run(copied_study, tiny):
    before = copied_study.runs()
    manifest = "results/runs/2nd_E1.1_K0.5_theta0/manifest.tsv"
    text = Path(law.__file__).read_text(encoding="utf-8")
    text = text.replace("    elastic, hardening = ", "    raise ValueError('stiffness')\n    ")
    (copied_study.folder / "mine.py").write_text(text, encoding="utf-8")
    failing = tiny | {"contact": {"law": {"file": "mine.py"}}}
    said = copied_study.failure(manifest, "--cores", "1", config=failing)
    log = copied_study.folder / "results/logs/coating/2nd_E1.1_K0.5_theta0.log"
    assert "stiffness" in log.read_text()
    assert "the same command goes on" in said
    assert copied_study.runs() == before
    copied_study.build(tiny, manifest)
    assert copied_study.runs() == before


def test_quick_study_can_draw_every_figure_and_other_studies_are_planned_when_asked_for(workspace):
    shutil.copy(workspace.folder / "config" / "quick.yaml", workspace.folder / "overlay.yaml")
    planned = workspace.dry_run("--configfile", "overlay.yaml")
    said = r"^bladerub: ([\d,]+) of \1 runs of the study .*; \d+ jobs, about \d+ min"
    assert re.search(said, planned, re.MULTILINE)
    assert {f"fig{n:02}" for n in range(1, 20)} == set(re.findall(r"results/figures/(fig\d\d)", planned))
    assert workspace.plan({}, "calibration").keys() == {"compile_kernel", "variation", "calibration"}
    others = {"chart", "rotor", "rotor37", "sweeps", "long_runs", "robustness", "identify"}
    assert others <= workspace.plan({}, *sorted(others)).keys()


@pytest.mark.nightly
def test_targets_that_are_not_part_of_all_can_be_made(copied_study, tiny):
    copied_study.build(
        tiny, "finer_bars", "more_nodes", "rigid_convergence", "accuracy", "steps", "heat", "rigs_image"
    )


def lines_of_ours(stderr):
    """All but what Snakemake says of its profile and of configs that lie over one another."""
    its_own = ("Config file config/config.yaml is extended", "Using workflow specific profile")
    return [line for line in stderr.splitlines() if not line.startswith(its_own)]


BOMB = "".join(f"{new}: &{new} [{', '.join([f'*{old}'] * 9)}]\n" for old, new in pairwise("abcdefg"))


def test_a_config_that_would_fill_the_memory(workspace):
    bomb = f"a: &a [x, x, x, x, x, x, x, x]\n{BOMB}"
    done = workspace.snakemake("--cores", "1", config=bomb)
    (line,) = lines_of_ours(done.stderr)
    assert line.startswith("overlay.yaml:1: not valid YAML")
    assert done.returncode == 2


def test_all_problems_are_reported_at_once_with_their_locations(workspace):
    (workspace.folder / "mine.yaml").write_text("\nblade:\n  length: 200\n")
    files, values = ("config/quick.yaml", "mine.yaml"), ("coating=[]", "figures={dpi: 2}")
    done = workspace.snakemake("--cores", "1", "--configfile", *files, "--config", *values)
    culprits = [line.split(" =")[0] for line in lines_of_ours(done.stderr)]
    assert culprits == ["mine.yaml:3: blade.length", "--config: coating", "--config: figures.dpi"]
    assert (done.returncode, done.stdout, workspace.results.exists()) == (2, "", False)


def test_files_lie_over_one_another_and_the_command_line_over_all(workspace, tiny):
    folder = workspace.folder
    (folder / "base.yaml").write_text(
        yaml.safe_dump(tiny | {"results": "base", "figures": {"dpi": 31, "max_frequency": 2}})
    )
    (folder / "mine.yaml").write_text(
        "results: own\nfigures: {dpi: 32}\n"
        "coatings: [{casing: 2nd, E: [2], K: [0.5], theta: [0.0, 0.15]}]\nsolver: {max_time_step: 25e-8}\n"
    )
    files, values = ("base.yaml", "mine.yaml"), ("figures={max_frequency: 1e0}", "results=said")
    planned = workspace.dry_run("--configfile", *files, "--config", *values)
    assert "said/maps/2nd_E2_K0.5_theta0.15.h5" in planned
    assert not re.search("2nd5nd|own/|base/", planned)
