"""A study of one's own, as `bladerub new` lays it out: the real workflow, taken in as a module."""

import json
from pathlib import Path

import pytest
import yaml
from workspace import ROOT, Workspace

from bladerub.study.store import read_run

OWN_RULE = """

rule own:
    input:
        rules.coating.output.map.format(coating="2nd_E1.1_K0.5_theta0"),
    output:
        "results/own.txt",
    shell:
        "du -b {input} > {output}"
"""


@pytest.fixture
def call(study):
    """Run a command of the environment in a folder, with the sources of the tests."""

    def call(folder: Path, program: str, *arguments: str) -> str:
        done = Workspace(folder, study.sources).call(program, *arguments)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return call


def test_it_computes_its_own_config_and_takes_rules_of_ones_own(tmp_path, call, tiny):
    call(tmp_path, "bladerub", "new", "own")
    folder = tmp_path / "own"
    (folder / "small.yaml").write_text(yaml.safe_dump(tiny))
    with (folder / "Snakefile").open("a") as snakefile:
        snakefile.write(OWN_RULE)
    call(folder, "snakemake", "own", "-j2", "--configfile", "small.yaml")
    assert "2nd_E1.1_K0.5_theta0.h5" in (folder / "results" / "own.txt").read_text()
    counts = json.loads(call(folder / "config", "bladerub", "status", "--json"))
    assert counts["coatings"]["2nd_E1.1_K0.5_theta0"]["missing"] == 0
    plan = call(folder, "snakemake", "-n", "--quiet", "rules", "--configfile", "small.yaml")
    assert "histograms" in plan


MODULE = """
configfile: "config/config.yaml"


module rub:
    snakefile:
        {snakefile!r}
    config:
        config["rub"]


use rule * from rub as rub_*
"""


def test_the_config_of_a_module_statement_is_that_of_the_study(tmp_path, call, tiny):
    tiny["coatings"] = [{"casing": "2nd", "E": [3], "K": [0.5], "theta": [0.0]}]
    (tmp_path / "Snakefile").write_text(MODULE.format(snakefile=str(ROOT / "Snakefile")))
    (tmp_path / "config").mkdir()
    content = {"samples": ["a"], "rub": {**tiny, "results": "results/rub"}}
    (tmp_path / "config" / "config.yaml").write_text(yaml.safe_dump(content))
    folder = tmp_path / "results" / "rub" / "runs" / "2nd_E3_K0.5_theta0"
    call(tmp_path, "snakemake", "-j2", f"{folder.relative_to(tmp_path)}/manifest.tsv")
    assert read_run(folder / "0.1500.h5").attributes["revolutions"] == tiny["solver"]["revolutions"]
    assert [path.parent for path in folder.parent.glob("*/manifest.tsv")] == [folder]
