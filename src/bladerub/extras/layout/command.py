"""``bladerub new``: a study of one's own, in a folder."""

import argparse
import shlex
import shutil
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from bladerub.cli import inputs
from bladerub.cli.inputs import refused
from bladerub.io.errors import BadInput
from bladerub.io.folders import ROOT

_TEMPLATE = Path(__file__).with_name("template")
_COPIED = ("config", "profiles")


def add_to(commands: Any) -> None:
    """Add this command to the subparsers `commands`."""
    parser = commands.add_parser(
        "new",
        help="lay out a study of one's own",
        description="Make a folder with a Snakefile, the config of the paper's study and its variations, and "
        "a README. `snakemake -j2` there computes what its config says.",
    )
    parser.add_argument("folder", type=Path, help="new or empty folder", metavar="FOLDER")
    parser.set_defaults(command=new)


def new(options: argparse.Namespace) -> None:
    """Lay out a study in the folder that the command line names."""
    folder = options.folder
    if folder.is_file() or (folder.is_dir() and any(folder.iterdir())):
        raise BadInput(f"{folder}: is there already, must be a new or an empty folder")
    inputs.require_writable("FOLDER", folder / "Snakefile")
    with refused(OSError):
        for name in _COPIED:
            shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
        shutil.copytree(_TEMPLATE, folder, dirs_exist_ok=True)
        (folder / ".gitignore").write_text("results/\n.snakemake/\n", encoding="utf-8")
    install = "" if find_spec("snakemake") else "pip install 'bladerub[study]' && "
    print(f"{folder}: edit config/config.yaml, then: {install}cd {shlex.quote(str(folder))} && snakemake -j2")
