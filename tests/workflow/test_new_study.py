"""A study of one's own, as `bladerub new` lays it out: the real workflow, taken in as a module."""

import json
import re

import yaml
from workspace import ROOT, Workspace

from bladerub.io.tables import read
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
    table = read(copied_study.results / "tables" / "deepest.csv", ["f_omega", "max_wear"])
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
