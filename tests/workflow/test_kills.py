"""Real kills of the real workflow; `kills.py` does it on a larger study, as often as asked."""

from __future__ import annotations

import itertools
import shutil

import kills
import pytest
import yaml


@pytest.fixture
def killed(study, tiny, tmp_path):
    """The tiny study without its results, to be made up to its peaks."""
    folder = tmp_path / "killed"
    shutil.copytree(study.folder, folder, ignore=shutil.ignore_patterns("results", ".snakemake"))
    (folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
    command = ("-j2", "results/tables/peaks.csv", "--configfile", "overlay.yaml")
    sources = {"PYTHONPATH": str(study.folder / "src")}  # whose machine code is there
    return kills.Study(folder, command, sources)


def test_kills_cost_nothing_but_what_they_interrupt(study, killed):
    seconds = 20.0  # about what it takes; a kill that comes too late is made up for
    done = list(itertools.islice(kills.torment(killed, None, seconds, seed=3), 3))
    assert [kill.way for kill in done] == list(kills.WAYS)
    process = killed.start()
    assert process.wait(kills.LAST) == 0, killed.output()
    for path in killed.results.rglob("*.*"):
        name = path.relative_to(killed.results)
        if path.is_file() and not kills.UNEQUAL.match(name.as_posix()):
            assert path.read_bytes() == (study.folder / "results" / name).read_bytes(), name
