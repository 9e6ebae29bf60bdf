"""Configs and results of other people: checked without running anything that they name."""

import json
import shutil
from argparse import Namespace

import pytest

from bladerub.cli import inputs, main
from bladerub.io.folders import ROOT

LAW = ROOT / "src" / "bladerub" / "extras" / "laws" / "brittle.py"


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A folder of a study, with a law that leaves a mark where it is executed."""
    (tmp_path / "config").mkdir()
    shutil.copy(ROOT / "config" / "config.yaml", tmp_path / "config")
    (tmp_path / "Snakefile").write_text("# of bladerub\n")
    (tmp_path / "results").mkdir()
    mark = f"open({str(tmp_path / 'executed')!r}, 'w')\nPARAMETERS = {{}}\n"
    (tmp_path / "evil.py").write_text(LAW.read_text().replace("PARAMETERS", "_UNUSED") + mark)
    monkeypatch.chdir(tmp_path)
    yield tmp_path
    assert not (tmp_path / "executed").exists()


def test_a_valid_config_is_summed_up_and_its_law_named_but_not_executed(study, capsys):
    (study / "theirs.yaml").write_text("contact: {law: {file: evil.py}}\n")
    assert main(["config", "theirs.yaml"]) == 0
    output = capsys.readouterr().out
    assert "12,096 runs" in output
    assert "executes evil.py" in output
    assert main(["config"]) == 0
    assert "executes no file" in capsys.readouterr().out


def _record(study, **law):
    made_with = {"files": [], "command_line": {"contact": {"law": law}}}
    (study / "results" / "config.json").write_text(json.dumps(made_with))


@pytest.mark.parametrize(
    "command", ["run --casing 2nd --E 2 --K 0.5 --f 0.19", "verify --sample 1 --seed 1", "benchmark"]
)
def test_results_from_elsewhere_execute_no_law(study, capsys, command):
    _record(study, file="evil.py")
    assert main(command.split()) == 2
    assert "evil.py" in (error := capsys.readouterr().err)
    assert "--trust" in error


def test_a_law_is_taken_from_the_results_if_trusted_of_the_package_or_of_the_study(study):
    options = Namespace(name="run", config=[], trust=True)
    _record(study, file="evil.py")
    assert inputs.read_config(options).contact.law.plain() == {"file": "evil.py"}
    options.trust = False
    _record(study, name="viscoplastic", viscosity=1e4)
    assert inputs.read_config(options).contact.law.name == "viscoplastic"
    config = study / "config" / "config.yaml"
    config.write_text(config.read_text().replace("contact:\n", "contact:\n  law: {file: evil.py}\n"))
    _record(study, file="evil.py")
    assert inputs.read_config(options).contact.law.plain() == {"file": "evil.py"}


def test_nothing_is_written_over(tmp_path, capsys):
    (tmp_path / "own").mkdir()
    (tmp_path / "own" / "file").touch()
    before = sorted(tmp_path.rglob("*"))
    for path in (tmp_path / "own", tmp_path / "own" / "file"):
        assert main(["new", str(path)]) == 2
        assert capsys.readouterr().err.startswith(f"bladerub new: {path}: ")
    assert sorted(tmp_path.rglob("*")) == before
