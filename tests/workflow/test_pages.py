"""The commands of the README and of the tutorials do what these say; those of the guides plan jobs.

They run as written, in a copy of the repository whose studies are tiny, in the environment of this test.
"""

import re
import sys
from pathlib import Path

import pytest
import yaml
from workspace import ROOT, TINY, Workspace

from bladerub.config.read import load
from bladerub.extras.records import record

INSTALL = re.compile(
    r"python3 -m venv .venv && .venv/bin/pip install -r environment.txt(?: && )?(?:.venv/bin/pytest)?"
)
BLOCK = re.compile(r"^```sh\n(.*?)^```$", re.M | re.S)
GUIDES = [ROOT / "docs" / "laws.md", *sorted((ROOT / "docs" / "how-to").glob("*.md"))]


def blocks(page: str | Path) -> list[str]:
    text = INSTALL.sub("", (ROOT / page).read_text(encoding="utf-8"))
    return [block for block in BLOCK.findall(text) if block.strip()]


def run(page: str | Path, workspace: Workspace) -> str:
    shell = ("/bin/bash", "-euo", "pipefail", "-c")
    return workspace.said(*shell, "\n".join(blocks(page)), MPLBACKEND="agg")


@pytest.fixture(scope="module")
def clone(study: Workspace, tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    """A copy of the complete tiny study, in which the full and the quick study are both the tiny one."""
    clone = study.copy(tmp_path_factory.mktemp("clone") / "bladerub")
    config, quick = (clone.folder / "config" / f"{name}.yaml" for name in ("config", "quick"))
    quick.write_text(yaml.safe_dump(TINY, sort_keys=False))
    config.write_text(yaml.safe_dump(load(config, quick), sort_keys=False))
    (clone.folder / ".venv").symlink_to(sys.prefix)
    return clone


def test_the_examples_of_the_readme(clone: Workspace):
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert len(INSTALL.findall(text)) == 2
    assert len(blocks("README.md")) == 2
    run("README.md", clone)
    assert (clone.results / "explorer.html").exists()
    printed = run_python("README.md", clone)
    assert "completed" in printed
    assert "\nMap\n" in printed
    assert {path.name for path in clone.folder.glob("*.png")} == {"wear.png", "history.png", "spectrum.png"}


def run_python(page: str, clone: Workspace) -> str:
    (example,) = re.findall(r"^```python\n(.*?)^```$", (ROOT / page).read_text(), re.M | re.S)
    return clone.said("python", "-W", "error", "-c", example, MPLBACKEND="agg")


def test_the_first_study(clone: Workspace):
    printed = run("docs/tutorials/first_study.md", clone)
    page = (ROOT / "docs/tutorials/first_study.md").read_text(encoding="utf-8")
    (shown,) = re.findall(r"^```text\n(coating  .*?)^```$", page, re.M | re.S)
    labels = [re.split(r" {2,}", line)[0] for line in shown.splitlines()]
    summary = printed[printed.index("\ncoating  ") + 1 :].splitlines()[: len(labels)]
    assert [re.split(r" {2,}", line)[0] for line in summary] == labels
    assert "C1a" in printed
    assert "xarray.Dataset" in printed
    assert run_python("docs/tutorials/first_study.md", clone).startswith("completed ")


@pytest.mark.nightly
def test_a_study_and_a_blade_of_ones_own(clone: Workspace):
    run("docs/tutorials/own_study.md", clone)
    results = clone.folder / "results_my_study"
    coatings = {f"2nd_E{E}_K{K}_theta0" for E in ("1.1", "2") for K in ("0.5", "1")}
    for made in (results / "maps").glob("*.h5"), (results / "figures" / "wear_map").glob("*.png"):
        assert {path.stem for path in made} == coatings
    assert [Path(file).name for file in record.read(results).files] == ["quick.yaml", "my_study.yaml"]

    figures = clone.folder / "results_my_blade" / "figures"
    made = sorted(path.relative_to(figures).as_posix() for path in figures.glob("**/*.png"))
    assert made == ["fig01_blade.png", "fig02_campbell.png", "wear_map/2nd_E2_K0.5_theta0.png"]


def test_the_guides_name_targets_that_exist(workspace: Workspace):
    """Of the full study with the coatings and speeds of the quick one; nothing has been computed."""
    quick, path = (workspace.folder / "config" / f"{name}.yaml" for name in ("quick", "config"))
    config = yaml.safe_load(path.read_text())
    config |= {key: yaml.safe_load(quick.read_text())[key] for key in ("coatings", "speeds", "chart")}
    path.write_text(yaml.safe_dump(config, sort_keys=False))
    gathered: dict[tuple[str, ...], set[str]] = {}  # targets by the options beside the number of cores
    for line in (line for page in GUIDES for block in blocks(page) for line in block.splitlines()):
        command, *words = line.split() or [""]
        if command != ".venv/bin/snakemake" or "slurm" in line or "--report" in line:
            continue
        words = [word for word in words if not re.fullmatch(r"-n|-j\d+", word)]
        first = next((at for at, word in enumerate(words) if word.startswith("-")), len(words))
        gathered.setdefault(tuple(words[first:]), set()).update(words[:first] or ["all"])
    assert len(gathered) > 1
    for options, targets in gathered.items():
        planned = workspace.dry_run(*targets, *options, "--quiet")
        assert all(target in planned for target in targets - {"all"}), options
