"""A copy of the repository in which the real workflow runs, small."""

from __future__ import annotations

import copy
import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
import yaml

ROOT = Path(__file__).parents[2]

# every figure can be drawn, but for one coating where the paper has many
TINY = {
    "blade": {"mesh": {"chordwise": 7, "thickness": 1, "spanwise": 6}},
    "reduction": {"accuracy_speeds": 3},
    "coatings": [
        {"casing": "2nd5nd", "E": [11], "K": [0.5], "theta": [0.0]},
        {"casing": "2nd", "E": [0.11, 1.1], "K": [0.5], "theta": [0.0]},
        {"casing": "2nd", "E": [2], "K": [0.5], "theta": [0.0, 0.15]},
        {"casing": "2nd", "coating": "rigid", "friction": [0.0]},
    ],
    "speeds": {"start": 0.15, "stop": 0.35, "step": 0.04, "extra": [0.197, 0.206]},
    "solver": {"revolutions": 3},
    "analysis": {"spectrum_revolutions": 2, "divergence": {"revolutions": 3, "confirmation_revolutions": 6}},
}


@dataclass
class Workspace:
    """A copy of what the workflow needs, and the command that runs it there."""

    folder: Path

    @classmethod
    def at(cls, folder: Path) -> Workspace:
        for part in ("config", "profiles", "src"):
            shutil.copytree(ROOT / part, folder / part)
        shutil.copy2(ROOT / "Snakefile", folder)
        return cls(folder)

    def snakemake(
        self, *arguments: str, config: dict[str, Any] | str | None = None
    ) -> subprocess.CompletedProcess:
        """Run Snakemake with `config` (a mapping, or the text of a file) laid over config/config.yaml."""
        if config is not None:
            text = config if isinstance(config, str) else yaml.safe_dump(config)
            (self.folder / "overlay.yaml").write_text(text)
            arguments = (*arguments, "--configfile", "overlay.yaml")
        return subprocess.run(
            [Path(sys.executable).with_name("snakemake"), *arguments],
            cwd=self.folder,
            env=os.environ | {"PYTHONPATH": str(self.folder / "src")},
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=600,
        )

    def plan(self, config: dict[str, Any], *targets: str) -> dict[str, int]:
        """Dry-run: how many jobs of each rule are planned."""
        done = self.snakemake(*targets, "--dry-run", config=config)
        assert done.returncode == 0, done.stderr
        text = done.stdout + done.stderr
        if "Nothing to be done" in text:
            return {}
        table = text.split("Job stats:")[1].split("total")[0]
        return {name: int(count) for name, count in re.findall(r"^(\w+)\s+(\d+)$", table, re.MULTILINE)}

    def build(self, config: dict[str, Any], *targets: str) -> None:
        """Run the workflow; it must succeed."""
        done = self.snakemake(*targets, "--cores", "2", config=config)
        assert done.returncode == 0, done.stderr


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
    shutil.copytree(study.folder, tmp_path / "copy")
    return Workspace(tmp_path / "copy")
