"""Each folder of extras and of studies can be deleted alone: all else works, or says what it needs."""

import shutil

import pytest
from workspace import ROOT

EXTRAS = sorted(path.parent.name for path in (ROOT / "src" / "bladerub" / "extras").glob("*/__init__.py"))
STUDIES = sorted(path.parent.name for path in (ROOT / "studies").glob("*/rules.smk"))
PROGRAM = """
import bladerub
from bladerub import plugins
from bladerub.cli import parser
for name in dir(bladerub):
    getattr(bladerub, name)
for kind in ("COMMANDS", "INVENTORIES", "LAWS", "MANIFESTS", "RUN_OPTIONS", "SOURCES", "SOLVERS"):
    plugins.loaded(kind)
parser().format_help()
"""


@pytest.mark.nightly
@pytest.mark.parametrize("name", EXTRAS)
def test_a_folder_of_extras_can_be_deleted(workspace, tiny, name):
    shutil.rmtree(workspace.sources / "bladerub" / "extras" / name)
    workspace.said("python", "-c", PROGRAM)
    planned = workspace.dry_run("--cores", "1", config=tiny)
    left_out = [line for line in planned.splitlines() if "without the study" in line]
    assert all(f"bladerub.extras.{name}" in line for line in left_out)


@pytest.mark.nightly
@pytest.mark.parametrize("name", STUDIES)
def test_a_study_can_be_deleted(workspace, tiny, name):
    shutil.rmtree(workspace.folder / "studies" / name)
    assert "coating" in workspace.plan(tiny)
