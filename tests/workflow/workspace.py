"""A copy of the repository in which the real workflow runs."""

import atexit
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import yaml

from bladerub.study.store import read_run

ROOT = Path(__file__).parents[2]
BIN = Path(sys.executable).parent

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
    "ensemble": {"members": 0},
    "analysis": {"spectrum_revolutions": 2, "divergence": {"revolutions": 3, "confirmation_revolutions": 6}},
}


@dataclass
class Workspace:
    """A copy of what the workflow needs, and the commands that run there.

    The package is imported from `sources`: of this copy, or of the repository, where its machine code is.
    """

    folder: Path
    sources: Path

    @classmethod
    def at(cls, folder: Path, sources: Path | None = None) -> "Workspace":
        """Lay it out in `folder`; `sources` are its own if not given."""
        for part in ("config", "profiles", "src", "studies"):
            shutil.copytree(ROOT / part, folder / part, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copy2(ROOT / "Snakefile", folder)
        return cls(folder, sources or folder / "src")

    def copy(self, folder: Path, *without: str) -> "Workspace":
        """Copy it with all that was made here but what is named `without`, to work with the same sources."""
        shutil.copytree(self.folder, folder, ignore=shutil.ignore_patterns(*without))
        return Workspace(folder, self.sources)

    def edit(self, file: str, before: str, after: str) -> None:
        """Change the first `before` of a file of the package into `after`, in this copy."""
        self.sources = self.folder / "src"
        path = self.sources / "bladerub" / file
        text = path.read_text(encoding="utf-8")
        assert before in text
        path.write_text(text.replace(before, after, 1), encoding="utf-8")

    @property
    def environment(self) -> dict[str, str]:
        return os.environ | {"PYTHONPATH": str(self.sources)}

    @property
    def results(self) -> Path:
        return self.folder / "results"

    def runs(self, pattern: str = "**/[0-9]*.h5") -> dict[str, tuple[int, int]]:
        """Each whole run, of a blade or a row, with what changes when it is written: inode and time."""
        whole = {}
        for folder in (self.results / "runs", self.results / "rotor" / "runs"):
            for path in sorted(folder.glob(pattern)):
                read_run(path)  # under its final name a file is whole at any time
                status = path.stat()
                whole[path.relative_to(folder).as_posix()] = (status.st_ino, status.st_mtime_ns)
        return whole

    def snakemake(self, *arguments, config=None) -> subprocess.CompletedProcess:
        """Run Snakemake with `config` (a mapping, or the text of a file) laid over config/config.yaml."""
        if config is not None:
            text = config if isinstance(config, str) else yaml.safe_dump(config)
            (self.folder / "overlay.yaml").write_text(text)
            arguments = (*arguments, "--configfile", "overlay.yaml")
        command = [str(BIN / "snakemake"), *arguments]
        with tempfile.TemporaryDirectory() as scratch:
            stdout, stderr = Path(scratch) / "stdout", Path(scratch) / "stderr"
            call = {"folder": self.folder, "environment": self.environment, "arguments": command}
            server = _warm_snakemake()
            print(json.dumps(call | {"stdout": stdout, "stderr": stderr}, default=str), file=server.stdin)
            server.stdin.flush()
            code = int(server.stdout.readline())
            return subprocess.CompletedProcess(command, code, stdout.read_text(), stderr.read_text())

    def call(self, program, *arguments, **environment) -> subprocess.CompletedProcess:
        streams = {"stdin": subprocess.DEVNULL, "capture_output": True, "encoding": "utf-8"}
        place = {"cwd": self.folder, "env": self.environment | environment}
        return subprocess.run([BIN / program, *arguments], timeout=600, errors="replace", **streams, **place)

    def said(self, program, *arguments, **environment) -> str:
        done = self.call(program, *arguments, **environment)
        assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-3000:]
        return done.stdout

    def begin(self, *arguments, **options) -> subprocess.Popen:
        """Start Snakemake with the overlay that is there and leave it at work; it writes to output.txt."""
        command = [BIN / "snakemake", *arguments, "--configfile", "overlay.yaml"]
        with (self.folder / "output.txt").open("w") as output:
            streams = {"stdin": subprocess.DEVNULL, "stdout": output, "stderr": output}
            return subprocess.Popen(command, cwd=self.folder, env=self.environment, **streams, **options)

    def dry_run(self, *arguments, config=None) -> str:
        done = self.snakemake(*arguments, "--dry-run", config=config)
        assert done.returncode == 0, (arguments, done.stderr)
        return done.stdout + done.stderr

    def failure(self, *arguments, config=None) -> str:
        """Return what Snakemake says, which must fail, and without a traceback."""
        done = self.snakemake(*arguments, config=config)
        assert done.returncode != 0
        assert "Traceback" not in done.stderr
        return done.stderr

    def plan(self, config: dict[str, Any], *targets: str) -> dict[str, int]:
        """Dry-run: how many jobs of each rule are planned. The folder keeps the config of its study."""
        overlay = self.folder / "overlay.yaml"
        of_study = overlay.read_text() if overlay.exists() else None
        text = self.dry_run(*targets, config=config)
        if of_study is not None:
            overlay.write_text(of_study)
        if "Nothing to be done" in text:
            return {}
        table = text.split("Job stats:")[1].split("total")[0]
        return {name: int(count) for name, count in re.findall(r"^(\w+)\s+(\d+)$", table, re.MULTILINE)}

    def build(self, config: dict[str, Any], *targets: str) -> None:
        done = self.snakemake(*targets, "--cores", "2", config=config)
        assert done.returncode == 0, done.stderr

    def status(self, *options: str) -> dict[str, Any]:
        """What `bladerub status` says of the study that was last given to Snakemake."""
        own_sources = str(self.folder / "src")  # its results are those beside its sources
        command = ("bladerub", "status", "--json", "--config", "overlay.yaml", *options)
        return json.loads(self.said(*command, PYTHONPATH=own_sources))


@cache
def _warm_snakemake() -> subprocess.Popen:
    program = Path(__file__).with_name("warm_snakemake.py")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    server = subprocess.Popen(
        [sys.executable, "-P", program],  # without this folder among those of modules
        env=environment | {"OPENBLAS_NUM_THREADS": "1"},  # a fork has no threads but its own
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )
    atexit.register(server.communicate)
    return server
