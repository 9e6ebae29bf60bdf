"""Copies of the repository in which mutants are tried."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mutants import Mutant

SOURCES = "src/bladerub"
FAILED = re.compile(r"^(?:FAILED|ERROR) (\S+)", re.MULTILINE)
PYTEST = ("-m", "pytest", "-n0", "-x", "-q", "-m", "not slow", "-p", "no:cacheprovider", "--tb=no", "-rfE")
DIGEST = "from bladerub.io.sources import solver_digest; print(solver_digest()[:16])"
COMPILED = {"energy", "friction", "gap", "law", "tip"}
"""Modules of `bladerub.contact`, outside its kernel, that machine code is made of."""


@dataclass(frozen=True)
class Room:
    """A folder, and the tests that are to notice mutants of its sources (patterns, from the root)."""

    folder: str
    tests: tuple[str, ...]

    def sources(self, root: Path) -> list[str]:
        """List the files of this room that are in no room inside it."""
        files = (path.relative_to(root).as_posix() for path in sorted((root / self.folder).rglob("*.py")))
        return [file for file in files if room_of(file) == self]


ROOMS = {
    "io": Room(f"{SOURCES}/io", ("tests/unit/io",)),
    "config": Room(f"{SOURCES}/config", ("tests/unit/config", "tests/unit/cli/test_cli.py")),
    "schema": Room("config", ("tests/unit/config",)),
    "study": Room(f"{SOURCES}/study", ("tests/unit/study",)),
    "findings": Room(
        f"{SOURCES}/study/findings", ("tests/unit/study/test_*find*.py", "tests/unit/study/test_claims.py")
    ),
    "contact": Room(f"{SOURCES}/contact", ("tests/unit/contact", "tests/validation/test_contact_*.py")),
    "kernel": Room(f"{SOURCES}/contact/kernel", ("tests/unit/contact", "tests/validation/test_contact_*.py")),
    "blade": Room(f"{SOURCES}/blade", ("tests/unit/blade", "tests/validation/test_blade_*.py")),
    "extras": Room(f"{SOURCES}/extras", ("tests/unit/extras",)),
    "explorer": Room(f"{SOURCES}/explorer", ("tests/unit/explorer",)),
}


def room_of(file: str) -> Room | None:
    """Find the innermost room that a file is in."""
    around = [room for room in ROOMS.values() if file.startswith(f"{room.folder}/")]
    return max(around, key=lambda room: len(room.folder), default=None)


class Copy:
    """A copy of the repository `root` in `folder`, where one mutant after another is tried."""

    def __init__(self, root: Path, folder: Path) -> None:
        self.folder = folder
        listed = subprocess.run(["git", "ls-files"], cwd=root, check=True, capture_output=True, text=True)
        for name in filter(lambda name: (root / name).is_file(), listed.stdout.splitlines()):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(root / name, folder / name)
        self.machine_code = folder / "machine-code"
        self.environment = os.environ | {
            "PYTHONPATH": str(folder / "src"),
            "PYTHONDONTWRITEBYTECODE": "1",
            "MPLBACKEND": "agg",
            "NUMBA_CACHE_DIR": str(self.machine_code),
        }
        self.seconds: dict[Room, float] = {}

    def warm_up(self, rooms: Sequence[Room]) -> None:
        """Run the tests of each room without a mutant: they must pass, and leave their machine code."""
        for room in rooms:
            failed, self.seconds[room] = self._test(room)
            if failed:
                raise RuntimeError(f"{failed} fails without any mutant")
        self._own_code = set(self.machine_code.glob("machine-code-*"))

    def try_mutant(self, mutant: Mutant) -> tuple[str, float]:
        """Run the tests with a mutant in its file; return the first that fails, and how long it took in s."""
        path = self.folder / mutant.file
        source = path.read_text(encoding="utf-8")
        room = room_of(mutant.file)
        try:
            path.write_text(mutant.apply(source), encoding="utf-8")
            if room == ROOMS["contact"] and Path(mutant.file).stem not in COMPILED:
                self._share_machine_code()
            return self._test(room, mutant.file, limit=4 * self.seconds[room] + 60)
        finally:
            path.write_text(source, encoding="utf-8")
            for folder in set(self.machine_code.glob("machine-code-*")) - self._own_code:
                folder.unlink() if folder.is_symlink() else shutil.rmtree(folder)

    def _test(self, room: Room, file: str = "", limit: float | None = None) -> tuple[str, float]:
        """Run the tests named after `file`, then those of the room; after `limit` s they have failed."""
        named_after = f"tests/unit/**/test_*{Path(file or 'none').stem}.py"
        tests = [path for pattern in (named_after, *room.tests) for path in sorted(self.folder.glob(pattern))]
        began = time.monotonic()
        try:
            done = self._python(*PYTEST, *map(str, dict.fromkeys(tests)), timeout=limit)
        except subprocess.TimeoutExpired:
            return "time-out", time.monotonic() - began
        if done.returncode == 0:
            return "", time.monotonic() - began
        failed = FAILED.search(done.stdout)
        if done.returncode < 0:
            return "crash", time.monotonic() - began
        if not failed and done.returncode not in (3, 4):  # a conftest that cannot be imported
            raise RuntimeError(f"pytest failed in {self.folder}:\n{done.stdout}{done.stderr}")
        return failed[1] if failed else "conftest", time.monotonic() - began

    def _share_machine_code(self) -> None:
        """Let a mutant that is not compiled itself use the machine code of the original."""
        digest = self._python("-c", DIGEST).stdout.strip()
        for own in self._own_code if digest else ():
            (self.machine_code / f"machine-code-{digest}").symlink_to(own)

    def _python(self, *arguments: str, timeout: float | None = None) -> subprocess.CompletedProcess:
        """Run Python in the copy; when it takes too long, end what it has started as well."""
        command = [sys.executable, *arguments]
        pipes = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        with subprocess.Popen(
            command, cwd=self.folder, env=self.environment, text=True, start_new_session=True, **pipes
        ) as process:
            try:
                output, errors = process.communicate(timeout=timeout)
            except BaseException:
                os.killpg(process.pid, 9)
                raise
        return subprocess.CompletedProcess(command, process.returncode, output, errors)
