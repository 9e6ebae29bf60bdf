"""The tiny study, and copies of the repository to run it in."""

import copy
from pathlib import Path
from typing import Any

import pytest
from workspace import TINY, Workspace


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark every test of this folder as slow: each runs the real workflow."""
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker("slow")


@pytest.fixture
def tiny() -> dict[str, Any]:
    """The overlay of the tiny study, to change at will."""
    return copy.deepcopy(TINY)


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    """Nothing has been computed here yet."""
    return Workspace.at(tmp_path)


@pytest.fixture(scope="session")
def study(tmp_path_factory: pytest.TempPathFactory) -> Workspace:
    """Here the tiny study is complete; tests leave it as it is."""
    workspace = Workspace.at(tmp_path_factory.mktemp("study"))
    workspace.build(TINY)
    return workspace


@pytest.fixture
def copied_study(study: Workspace, tmp_path: Path) -> Workspace:
    """A copy of the complete study that a test may change."""
    return study.copy(tmp_path / "copy")
