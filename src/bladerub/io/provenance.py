"""Where a file comes from: version, sources, config and packages that made it.

Nothing here depends on the machine or the time, so that equal studies have equal files, and no run key and no
digest of the blade depends on any of it.
"""

import hashlib
import json
import os
import platform
import subprocess
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from typing import Any

from bladerub import __version__
from bladerub.io.folders import ROOT

PREFIX = "provenance_"  # of the name of each of these attributes, and of no other
UNKNOWN = "unknown"

_PACKAGES = ("numpy", "scipy", "numba", "h5py", "scikit-fem", "rslab", "pandas", "openturns")
_SECONDS = 10


def provenance(config: Mapping[str, Any]) -> dict[str, str]:
    """Describe what makes a file of the study `config` now, as attributes for it.

    The commit is that of the repository that the package is installed from, which is ``modified`` if a file
    in it differs from the commit, or one of its sources is not in it. What git does not know is ``unknown``.
    """
    commit, state = git_state()
    return {
        f"{PREFIX}software": f"bladerub {__version__}",
        f"{PREFIX}git_commit": commit,
        f"{PREFIX}git_state": state,
        f"{PREFIX}config_sha256": config_digest(config),
        f"{PREFIX}packages": packages(),
    }


def software() -> str:
    """Describe the same on one line, without config and packages."""
    commit, state = git_state()
    return f"bladerub {__version__}, git commit {commit} ({state})"


def config_digest(config: Mapping[str, Any]) -> str:
    """Digest (SHA-256) what the config says, not how it is written, nor where the results go."""
    study = json.dumps({key: value for key, value in config.items() if key != "results"})
    in_floats = json.dumps(json.loads(study, parse_int=float), sort_keys=True)
    return hashlib.sha256(in_floats.encode()).hexdigest()


@cache
def git_state() -> tuple[str, str]:
    """Return commit and state of the repository, once for each process (see `provenance`)."""
    # a repository that this one only lies in is another's, and a hook of git names the one it runs for
    environment = {name: value for name, value in os.environ.items() if not name.startswith("GIT_")}
    environment |= {"GIT_CEILING_DIRECTORIES": str(ROOT.parent), "GIT_OPTIONAL_LOCKS": "0"}
    command = ["git", "status", "--porcelain=v2", "--branch", "--untracked-files=normal"]
    try:
        status = subprocess.run(
            command,
            cwd=ROOT,
            env=environment,
            stdin=subprocess.DEVNULL,
            capture_output=True,
            encoding="utf-8",
            errors="replace",
            timeout=_SECONDS,
            check=True,
        ).stdout
    except (OSError, subprocess.SubprocessError):
        return UNKNOWN, UNKNOWN
    commit, modified = UNKNOWN, False
    for line in status.splitlines():
        if line.startswith("# branch.oid "):
            commit = line.split()[-1]
        elif not line.startswith(("#", "?")) or line.startswith("? src/"):
            modified = True
    if set(commit) - set("0123456789abcdef"):  # "(initial)": nothing is committed yet
        return UNKNOWN, UNKNOWN
    return commit, "modified" if modified else "clean"


@cache
def packages() -> str:
    """Versions of what shapes the numbers."""
    versions = [f"python=={platform.python_version()}"]
    for name in _PACKAGES:
        with suppress(PackageNotFoundError):
            versions.append(f"{name}=={version(name)}")
    return " ".join(versions)
