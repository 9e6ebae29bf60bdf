"""Folders: the workflow that comes with the package, the study at work, and the cache of this user."""

import errno
import getpass
import os
import tempfile
from pathlib import Path

import platformdirs

PACKAGE = Path(__file__).parents[1]
_CHECKOUT = PACKAGE.parents[1]

ROOT = _CHECKOUT if (_CHECKOUT / "Snakefile").is_file() else PACKAGE / "repository"
"""Snakefile, rules, scripts and configs: the repository, or the copy of these that an installed wheel has."""
BENCHMARKS = ROOT / "benchmarks"  # reference numbers, a folder for each blade
CONFIG = Path("config", "config.yaml")  # the config of a study, in its folder


def study_folder() -> Path:
    """Find the folder of the study at work, which the paths of its config are relative to.

    It is the working directory or the closest folder above with a `CONFIG` and a Snakefile that names
    bladerub; else the repository that the package is installed from in place, or the working directory.
    """
    working_folder = Path.cwd()
    for folder in (working_folder, *working_folder.parents):
        snakefile = folder / "Snakefile"
        is_whole = (folder / CONFIG).is_file() and snakefile.is_file()
        if is_whole and "bladerub" in snakefile.read_text(encoding="utf-8", errors="replace"):
            return folder
    return working_folder if ROOT.is_relative_to(PACKAGE) else ROOT


def base_config() -> Path:
    """Find the config that others are laid over: of `study_folder`, or the paper's."""
    config = study_folder() / CONFIG
    return config if config.is_file() else ROOT / CONFIG


def has_home() -> bool:
    """Return whether this user has a home to write to; the user of a container may have none."""
    return os.access(os.path.expanduser("~"), os.W_OK)


def cache_folder() -> Path:
    """Return the folder of what is kept for this user beside studies, such as blades and machine code.

    It is ``BLADERUB_CACHE``, or where the system wants it (``XDG_CACHE_HOME``), or, without a home, of this
    user alone among the temporary files (``TMPDIR``). Raises an `OSError` if others can write that one.
    """
    if path := os.environ.get("BLADERUB_CACHE"):
        return Path(path)
    if has_home() or "XDG_CACHE_HOME" in os.environ:
        return platformdirs.user_cache_path("bladerub")
    folder = Path(tempfile.gettempdir(), f"bladerub-{os.getuid()}")
    folder.mkdir(mode=0o700, exist_ok=True)
    about = folder.lstat()
    if about.st_uid != os.getuid() or about.st_mode & 0o022:  # who can write machine code can run programs
        problem = "can be written by others; name a folder of your own with BLADERUB_CACHE"
        raise OSError(errno.EEXIST, problem, str(folder))
    return folder


def provide_for_unknown_user() -> None:
    """Name the user for Snakemake, and a folder for Matplotlib, where the system knows neither.

    So it is in a container under the number of another machine's user. Processes started inherit both.
    """
    try:
        getpass.getuser()
    except (KeyError, OSError):
        os.environ["USER"] = str(os.getuid())
    if not has_home():
        os.environ.setdefault("MPLCONFIGDIR", str(cache_folder() / "matplotlib"))
