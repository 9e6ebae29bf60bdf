"""What the folders of `bladerub.extras` add, and that the core does without them."""

import os
import re
import shutil
import subprocess
import sys

import pytest

import bladerub as br
from bladerub import plugins
from bladerub.cli import main
from bladerub.io.folders import PACKAGE

PROGRAM = """
import bladerub, bladerub.api.run, bladerub.cli.status
from bladerub.cli import parser
print(*parser()._subparsers._group_actions[0].choices)
print(*dir(bladerub))
"""


def test_names_and_commands_of_extras_are_public():
    assert {"Rig", "simulate_rig", "fit_coating"} <= set(dir(br))
    assert br.Rig.__module__ == "bladerub.extras.rig.spec"
    with pytest.raises(AttributeError, match="no attribute 'Rigs'"):
        _ = br.Rigs


def test_the_core_names_no_extra():
    """Neither by import nor by string."""
    folders = [path.name for path in (PACKAGE / "extras").iterdir() if path.is_dir()]
    named = re.compile(rf"\bextras[./](?:{'|'.join(folders)})\b")
    core = [path for path in PACKAGE.rglob("*.py") if PACKAGE / "extras" not in path.parents]
    assert len(core) > 100
    assert not [path for path in core if named.search(path.read_text(encoding="utf-8"))]


def test_the_core_does_without_extras(tmp_path):
    without = shutil.ignore_patterns("extras", "__pycache__", "repository")
    shutil.copytree(PACKAGE, tmp_path / "bladerub", ignore=without)
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    lines = subprocess.check_output([sys.executable, "-c", PROGRAM], env=environment, text=True).splitlines()
    assert lines[0].split() == ["new", "run", "status"]
    assert "Rig" not in lines[1]
    assert "simulate" in lines[1]


def test_a_command_says_which_folder_it_needs(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "bladerub.extras.verification.element_law", None)
    assert main(["check-law", "brittle", "--parameter", "break_strain=0.1"]) == 2
    assert "needs bladerub.extras.verification.element_law, which this package" in capsys.readouterr().err


def test_a_folder_adds_nothing_without_what_it_needs(monkeypatch, tmp_path):
    for path in (PACKAGE / "extras").glob("*/plugin.py"):
        (tmp_path / path.parent.name).mkdir()
        (tmp_path / path.parent.name / "plugin.py").touch()
    shutil.rmtree(tmp_path / "rows")
    monkeypatch.setattr(plugins, "EXTRAS", tmp_path)
    assert "rows of blades" not in plugins.offered.__wrapped__("INVENTORIES")
    assert "columns" in plugins.offered.__wrapped__("MANIFESTS")
