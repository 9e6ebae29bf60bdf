"""A copy of the repository in which the real workflow runs."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import yaml

ROOT = Path(__file__).parents[2]


@dataclass
class Workspace:
    """A copy of what the workflow needs, and the command that runs it there."""

    folder: Path

    @property
    def environment(self) -> dict[str, str]:
        """For commands that are to use the sources of this copy."""
        return os.environ | {"PYTHONPATH": str(self.folder / "src")}

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
            env=self.environment,
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
