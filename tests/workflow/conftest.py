"""The tiny study, and copies of the repository to run it in."""

import copy
import os
from pathlib import Path
from typing import Any

import pytest
from workspace import ROOT, TINY, Workspace

from bladerub.io import lock

# the tests start hundreds of processes, and translating the package would be a fifth of the time of each
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)

FOLDER = Path(__file__).parent
AT_WORK_MEANWHILE = (
    *("test_laws.py", "test_contact_nodes.py", "test_contact_laws.py", "test_row.py", "test_emulation.py"),
    *("test_blade_rotor37.py", "test_blade_default.py"),
)
"""Files that take long and need no study."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark every test of this folder as slow, and put first what makes the study that all others of it copy.

    Files go to pytest's processes in this order: long ones without the study come next, short ones last.
    """
    for item in items:
        if FOLDER in item.path.parents:
            item.add_marker("slow")
    items.sort(key=_place)


def _place(item: pytest.Item) -> int:
    if item.path.name in AT_WORK_MEANWHILE:
        return 1
    if FOLDER in item.path.parents:
        return 0 if item.path.name == "test_at_once.py" else 2
    return 3


@pytest.fixture
def tiny() -> dict[str, Any]:
    return copy.deepcopy(TINY)


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    return Workspace.at(tmp_path)


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory, worker_id: str) -> Workspace:
    """Here the tiny study is complete; tests leave it as it is. One process makes it, each takes a copy.

    Machine code belongs to the path of its sources, so all use those of the repository.
    """
    base = tmp_path_factory.getbasetemp()
    original = (base if worker_id == "master" else base.parent) / "study"
    complete = original.with_suffix(".complete")
    with lock.held(original.with_suffix(".lock"), lambda: None):
        if not complete.exists():
            Workspace.at(original, ROOT / "src").build(TINY)
            complete.touch()
    return Workspace(original, ROOT / "src").copy(tmp_path_factory.mktemp("study") / "copy")


@pytest.fixture
def copied_study(study: Workspace, tmp_path: Path) -> Workspace:
    return study.copy(tmp_path / "copy")
