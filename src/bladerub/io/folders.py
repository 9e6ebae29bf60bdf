"""Folders: the workflow that comes with the package, the study at work, and the cache of this user."""

import os
from pathlib import Path

import platformdirs

PACKAGE = Path(__file__).parents[1]
_CHECKOUT = PACKAGE.parents[1]

ROOT = _CHECKOUT if (_CHECKOUT / "Snakefile").is_file() else PACKAGE / "repository"
"""Snakefile, rules, scripts and configs: the repository, or the copy of these that an installed wheel has."""

BENCHMARKS = ROOT / "benchmarks"
"""Reference numbers, a folder for each blade."""

CONFIG = Path("config", "config.yaml")
"""The config of a study, in its folder."""


def study_folder() -> Path:
    """Find the folder of the study at work, which the paths of its config are relative to.

    It is the working directory or the closest folder above that has a `CONFIG` and a Snakefile that names
    bladerub. If there is none, it is the repository that the package is installed from in place, or the
    working directory itself.
    """
    here = Path.cwd()
    for folder in (here, *here.parents):
        if _is_study(folder):
            return folder
    return here if ROOT.is_relative_to(PACKAGE) else ROOT


def _is_study(folder: Path) -> bool:
    snakefile = folder / "Snakefile"
    if not (folder / CONFIG).is_file() or not snakefile.is_file():
        return False
    return "bladerub" in snakefile.read_text(encoding="utf-8", errors="replace")


def base_config() -> Path:
    """Find the config that others are laid over: of `study_folder`, or the paper's."""
    own = study_folder() / CONFIG
    return own if own.is_file() else ROOT / CONFIG


def cache_folder() -> Path:
    """Return the folder of blades built outside a study: ``BLADERUB_CACHE``, or where the system wants it."""
    return Path(os.environ.get("BLADERUB_CACHE") or platformdirs.user_cache_path("bladerub"))
