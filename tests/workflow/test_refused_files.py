"""What the system refuses to read (locks, permissions, failing disks) is neither lost nor made again."""

import errno
import fcntl
import os
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest

BIN = Path(sys.executable).parent
REFUSALS = Path(__file__).with_name("refusals")
FILES = {
    "runs": r"/runs/.*\.h5$",
    "maps": r"/maps/.*\.h5$",
    "ensembles": r"/ensembles?/.*\.h5$",
    "manifests": r"/manifest\.tsv$",
    "blade": r"/blade/.*\.h5$",
    "tables": r"/tables/.*\.csv$",
}
COATING = "2nd_E1.1_K0.5_theta0"
RUN = ("run", "--casing", "2nd", "--E", "1.1", "--K", "0.5", "--f", "0.197", "--revolutions", "1")
COMMANDS = [
    ("bladerub", "status"),
    ("bladerub", "status", "--thorough"),
    ("bladerub", "status", "--thorough", "--discard"),
    ("bladerub", "verify", "--sample", "1", "--seed", "1"),
    ("bladerub", *RUN),
    ("bladerub", "export", "--animation", "a.gif", "--run", f"results/runs/{COATING}/0.1970.h5"),
    ("snakemake", "-j1", "--quiet", "all", "--dry-run"),
    ("snakemake", "-j1", "--quiet", "all", "--keep-going"),
    ("python", "-c", f"import bladerub as br; br.read_map('results/maps/{COATING}.h5')"),
]


@pytest.fixture
def results(copied_study, tiny):
    tiny["ensemble"] = {"members": 2}
    copied_study.build(tiny)
    copied_study.use_own_sources()
    return copied_study.results


def contents(results):
    """All that a study keeps, with what changes when a file is written."""
    folders = ("blade", "runs", "maps", "ensembles", "tables", "figures")
    paths = [path for folder in folders for path in (results / folder).rglob("*") if path.is_file()]
    return {path: (path.stat().st_ino, path.stat().st_mtime_ns, path.read_bytes()) for path in paths}


def call(study, monkeypatch, command, **refusals):
    """Run a command with the study's config and with what is to be refused; return its answer."""
    name, *arguments = command
    if name != "python":
        arguments += ["--configfile" if name == "snakemake" else "--config", "overlay.yaml"]
    with monkeypatch.context() as patch:
        for key, value in refusals.items():
            patch.setenv(key, value)
        patch.setattr(type(study), "environment", os.environ | {"PYTHONPATH": f"{REFUSALS}:{study.sources}"})
        return study.call(BIN / name, *arguments)


@pytest.mark.parametrize("code", [errno.EACCES, errno.EMFILE, errno.EIO])
def test_what_the_system_refuses_is_kept_by_all_commands(copied_study, results, monkeypatch, code):
    before = contents(results)
    for kind, pattern in FILES.items():
        for command in COMMANDS:
            done = call(copied_study, monkeypatch, command, REFUSED=pattern, REFUSAL=str(code))
            assert contents(results) == before, (kind, command, done.stderr)
            assert command[0] == "python" or "Traceback" not in done.stderr, (kind, command, done.stderr)


def test_locked_runs_are_not_computed_again_for_another_speed(copied_study, tiny, results):
    written = copied_study.runs()
    tiny["ensemble"] = {"members": 2}
    tiny["speeds"]["extra"] = [*tiny["speeds"]["extra"], 0.21]
    with ExitStack() as stack:
        for name in written:
            file = stack.enter_context(open(results / "runs" / name, "rb"))
            fcntl.flock(file, fcntl.LOCK_EX)
        failed = copied_study.snakemake("--cores", "2", "--keep-going", config=tiny)
    assert failed.returncode != 0
    assert "HDF5_USE_FILE_LOCKING=FALSE" in failed.stderr
    assert "Traceback" not in failed.stderr
    copied_study.build(tiny)
    now = copied_study.runs()
    assert {name: now[name] for name in written} == written
    assert len(now) > len(written)
