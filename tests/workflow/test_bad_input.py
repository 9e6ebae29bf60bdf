"""Bad configs by the real workflow, one of a kind: a line with the culprit, exit code 2, nothing written."""

import re
from itertools import pairwise

import yaml


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
