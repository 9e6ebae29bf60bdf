"""Put every bad input through the real commands, from a copy of the repository, and say what came of it.

    .venv/bin/python tests/workflow/all_bad_inputs.py [--verbose]

Takes some minutes. Ends with exit code 1 if one input was answered otherwise than it should be.
"""

import hashlib
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from bad_inputs import COMMANDS, CONFIGS, UNREADABLE, make_files
from broken_blades import IMPORTS, make_blades
from test_bad_input import lines_of_ours, write_overlay
from workspace import Workspace

WRITTEN_ANYWAY = (".snakemake/", "src/bladerub/", "overlay.yaml")
"""Snakemake's own notes, byte code, and the input itself."""


def contents(folder: Path) -> dict[str, str]:
    """Digest every file of `folder` by its name."""
    names = (path for path in folder.rglob("*") if not path.is_dir())
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else ""
        for path in names
        if not str(path.relative_to(folder)).startswith(WRITTEN_ANYWAY)
    }


def run(workspace: Workspace, program: str, arguments: list[str]) -> subprocess.CompletedProcess:
    """Run one of the commands of the environment in the copy."""
    return subprocess.run(
        [Path(sys.executable).with_name(program), *arguments],
        cwd=workspace.folder,
        env=os.environ | {"PYTHONPATH": str(workspace.folder / "src")},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
    )


def cases() -> Iterator[tuple[str, dict | str | bytes | None, str, list[str]]]:
    """Yield each input: its name, the config if it is one, the words of the answer, the command line."""
    for name, (config, words) in CONFIGS.items():
        yield name, config, words, ["snakemake", "--cores", "1", "--configfile", "overlay.yaml"]
    for name, (config, words) in (CONFIGS | UNREADABLE).items():
        yield name, config, words, ["snakemake", "--cores", "1", "--config", "extend=overlay.yaml"]
    for line, words in (COMMANDS | IMPORTS).items():
        yield line[:80], None, words, ["bladerub", *line.split()]


def main() -> int:
    """Try all of them."""
    n_cases = n_bad = 0
    with tempfile.TemporaryDirectory() as folder:
        workspace = Workspace.at(Path(folder))
        make_files(workspace.folder)
        make_blades(workspace.folder)
        before = contents(workspace.folder)
        for name, config, words, (program, *arguments) in cases():
            if config is not None:
                write_overlay(workspace.folder, config)
            done = run(workspace, program, arguments)
            checks = {
                f"exit code {done.returncode}": done.returncode == 2,
                "traceback": "Traceback" not in done.stderr,
                "more than one line": len(lines_of_ours(done.stderr)) == 1,
                "other words": words in done.stderr,
                "something on standard output": not done.stdout,
                "something written": contents(workspace.folder) == before,
            }
            wrong = [what for what, is_right in checks.items() if not is_right]
            n_cases, n_bad = n_cases + 1, n_bad + bool(wrong)
            if wrong or "--verbose" in sys.argv:
                print(f"{program} {name}: {', '.join(wrong) or 'as it should be'}\n    {done.stderr[-300:]}")
    print(f"{n_cases} bad inputs, {n_cases - n_bad} answered as they should be")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
