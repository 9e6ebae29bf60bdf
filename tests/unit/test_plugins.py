"""What the folders of `bladerub.extras` add, and that the core does without them."""

import os
import re
import shutil
import subprocess
import sys
from types import SimpleNamespace

import pytest
from blade_parts import TWISTED

import bladerub as br
from bladerub import plugins
from bladerub.blade.source import reader
from bladerub.cli import main, parser, run
from bladerub.cli.run import RunOption
from bladerub.extras.blades.settings import Source
from bladerub.io.errors import BadInput
from bladerub.io.folders import PACKAGE, ROOT
from bladerub.plugins import load
from bladerub.settings.study import required, whole

PROGRAM = """
import sys
import bladerub, bladerub.api.run
from bladerub.cli import parser
from bladerub.config.errors import ConfigError
from bladerub.config.read import read
study, mine = sys.argv[1:]
print(*parser()._subparsers._group_actions[0].choices)
print(*dir(bladerub))
print(*read(study).plain())
try:
    read(study, mine)
except ConfigError as error:
    print(error)
"""


def test_names_and_commands_of_extras_are_public():
    assert {"Rig", "simulate_rig", "fit_coating"} <= set(dir(br))
    assert br.Rig.__module__ == "bladerub.extras.rig.spec"


def test_the_core_names_no_extra():
    """Neither by import nor by string."""
    folders = [path.name for path in (PACKAGE / "extras").iterdir() if path.is_dir()]
    named = re.compile(rf"\bextras[./](?:{'|'.join(folders)})\b")
    core = [path for path in PACKAGE.rglob("*.py") if PACKAGE / "extras" not in path.parents]
    assert len(core) > 100
    assert not [path for path in core if named.search(path.read_text(encoding="utf-8"))]


def test_the_core_does_without_extras_and_refuses_their_keys_in_a_line(tmp_path):
    without = shutil.ignore_patterns("extras", "__pycache__", "repository")
    shutil.copytree(PACKAGE, tmp_path / "bladerub", ignore=without)
    mine = tmp_path / "mine.yaml"
    mine.write_text("chart: {casing: 2nd}\nblade: {source: {file: a.inp}}\nsolver: {device: gpu}\n")
    command = [sys.executable, "-c", PROGRAM, ROOT / "config" / "config.yaml", mine]
    environment = os.environ | {"PYTHONPATH": str(tmp_path)}
    text = subprocess.check_output(command, env=environment, cwd=tmp_path, text=True)
    commands, names, keys, *problems = text.splitlines()
    assert commands.split() == ["run"]
    assert "Rig" not in names
    assert "simulate" in names
    assert set(keys.split()) == required()
    assert [line.partition(" = ")[0] for line in problems] == [
        "mine.yaml:2: blade.source",
        "mine.yaml:1: chart",
        "mine.yaml:3: solver.device",
    ]


def test_a_command_says_which_folder_it_needs(monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, "bladerub.extras.verification.element_law", None)
    assert main(["check-law", "brittle", "--parameter", "break_strain=0.1"]) == 2
    assert "needs bladerub.extras.verification.element_law, which this package" in capsys.readouterr().err


def test_a_folder_adds_nothing_without_what_it_needs(monkeypatch, tmp_path):
    for path in (PACKAGE / "extras").glob("*/plugin.py"):
        (tmp_path / path.parent.name).mkdir()
        (tmp_path / path.parent.name / "plugin.py").touch()
    shutil.rmtree(tmp_path / "rows")
    assert "rows of blades" in plugins.offered("INVENTORIES")
    monkeypatch.setattr(plugins, "EXTRAS", tmp_path)
    assert "rows of blades" not in plugins.offered.__wrapped__("INVENTORIES")
    assert "columns" in plugins.offered.__wrapped__("MANIFESTS")


@pytest.mark.parametrize("place", ["extras.none.reader", "extras.blades.none", "contact.law:none"])
def test_what_a_plugin_names_and_is_not_there_is_refused_in_a_line(place):
    with pytest.raises(plugins.MissingPart, match=r"^bladerub\.\S+: .*plugin.py .*adds$"):
        plugins.load(place)


@pytest.mark.parametrize("added", [{"COMMAND": {}}, {"LAWS": ["a"]}, {"LAWS": {"a": "extras.a"}}])
def test_what_a_plugin_cannot_add_is_refused_in_a_line(monkeypatch, added):
    monkeypatch.setattr(
        plugins, "import_module", lambda name: SimpleNamespace(__file__="x/plugin.py", **added)
    )
    with pytest.raises(plugins.MissingPart, match=f"^x/plugin.py: {next(iter(added))}: "):
        plugins.offered.__wrapped__("LAWS")


class Twice(RunOption):
    def add_to(self, options):
        options.option("--output", "again")


@pytest.mark.parametrize(
    ("kind", "added", "made", "culprit"),
    [
        ("SECTIONS", {"solver": "settings.study:Speeds"}, whole, "solver: is a key"),
        ("SECTIONS", {"casings.amplitude": "settings.study:Speeds"}, whole, "amplitude: is a key"),
        ("RUN_OPTIONS", {"a": "contact.law"}, parser, "contact.law: must be"),
        ("RUN_OPTIONS", {"a": f"{__name__}:Twice"}, parser, "--output"),
    ],
)
def test_what_disagrees_with_the_core_is_refused(monkeypatch, kind, added, made, culprit):
    offered = plugins.offered
    monkeypatch.setattr(plugins, "offered", lambda of: added if of == kind else offered(of))
    monkeypatch.setattr(plugins, "load", lambda place: Twice if "Twice" in place else load(place))
    monkeypatch.setattr(run, "_options", run._options.__wrapped__)
    with pytest.raises(plugins.MissingPart, match=culprit):
        getattr(made, "__wrapped__", made)()


def test_a_source_of_blades_lacks_no_function(monkeypatch):
    monkeypatch.setattr(plugins, "offered", lambda kind: {"file": "contact.law"})
    with pytest.raises(BadInput, match=r"^bladerub\.contact\.law: has no problems, recipe, files, build,"):
        reader(TWISTED.replaced("source", Source(file="blade.inp")))
