"""Put each fault of named.toml into a copy of the repository, and see whether its tests notice it.

python .ci/mutation/run.py [PART OF A NAME...]    # exit code 0 if all are noticed
"""

import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

ROOT = Path(__file__).parents[2]
PYTEST = ("-m", "pytest", "-n0", "-x", "-q", "-m", "not slow and not nightly", "-p", "no:cacheprovider")


def tests_of(folder: Path, file: str) -> list[Path]:
    """List the tests of the room of a source, those named after the source first."""
    path = Path(file)
    room, stem = path.parts[2 if path.parts[0] == "src" else 0], path.stem
    named_after = sorted((folder / "tests").glob(f"**/test_*{stem}.py"))
    physics = sorted((folder / "tests" / "validation").glob(f"test_{room}_*.py"))
    return [*named_after, folder / "tests" / "unit" / room, *physics]


def is_noticed(folder: Path, fault: dict[str, str]) -> bool:
    """Whether a test fails with the fault; what it replaces must be in its file exactly once."""
    path = folder / fault["file"]
    source = path.read_text(encoding="utf-8")
    if source.count(fault["before"]) != 1:
        raise ValueError(f"{fault['name']}: {source.count(fault['before'])} times in {fault['file']}")
    path.write_text(source.replace(fault["before"], fault["after"]), encoding="utf-8")
    environment = os.environ | {"PYTHONPATH": str(folder / "src"), "MPLBACKEND": "agg"}
    command = [sys.executable, *PYTEST, *map(str, tests_of(folder, fault["file"]))]
    try:
        return subprocess.run(command, cwd=folder, env=environment, capture_output=True).returncode != 0
    finally:
        path.write_text(source, encoding="utf-8")


def main() -> int:
    """Try the faults and say which were not noticed."""
    faults = tomllib.loads(Path(__file__).with_name("named.toml").read_text(encoding="utf-8"))["fault"]
    chosen = [fault for fault in faults if all(part in fault["name"] for part in sys.argv[1:])]
    missed = 0
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch) / "copy"
        shutil.copytree(ROOT, folder, ignore=shutil.ignore_patterns(".*", "results", "__pycache__"))
        for fault in chosen:
            noticed = is_noticed(folder, fault)
            missed += not noticed
            print("noticed " if noticed else "SURVIVED", fault["name"], flush=True)
    return 1 if missed else 0


if __name__ == "__main__":
    raise SystemExit(main())
