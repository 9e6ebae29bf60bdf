"""What the system refuses to read (locks, permissions, failing disks) is neither lost nor made again."""

import errno
import fcntl
from contextlib import ExitStack
from pathlib import Path

import pytest
from commands import ON_RESULTS, call

REFUSALS = Path(__file__).with_name("refusals")
FILES = {
    "runs": r"/runs/.*\.h5$",
    "maps": r"/maps/.*\.h5$",
    "ensembles": r"/ensembles?/.*\.h5$",
    "manifests": r"/manifest\.tsv$",
    "blade": r"/blade/.*\.h5$",
    "tables": r"/tables/.*\.csv$",
}


def contents(results):
    """All that a study keeps, with what changes when a file is written."""
    folders = ("blade", "runs", "maps", "ensembles", "tables", "figures")
    paths = [path for folder in folders for path in (results / folder).rglob("*") if path.is_file()]
    return {path: (path.stat().st_ino, path.stat().st_mtime_ns, path.read_bytes()) for path in paths}


def keeps_all(study, kinds, commands, code):
    before = contents(study.results)
    for kind in kinds:
        for command in commands:
            path = f"{REFUSALS}:{study.sources}"
            done = call(study, command, PYTHONPATH=path, REFUSED=FILES[kind], REFUSAL=str(code))
            assert contents(study.results) == before, (kind, command, done.stderr)
            assert command[0] == "python" or "Traceback" not in done.stderr, (kind, command, done.stderr)


def test_runs_that_the_system_refuses_are_kept(copied_study):
    discarding, computing = ON_RESULTS[2], ON_RESULTS[8]
    keeps_all(copied_study, ["runs"], (discarding, computing), errno.EIO)


@pytest.mark.nightly
def test_what_the_system_refuses_is_kept_by_all_commands(copied_study, tiny):
    copied_study.build(tiny | {"ensemble": {"members": 2}})
    keeps_all(copied_study, FILES, ON_RESULTS, errno.EACCES)


def test_locked_runs_are_not_computed_again_for_another_speed(copied_study, tiny):
    written = copied_study.runs()
    tiny["speeds"]["extra"] = [*tiny["speeds"]["extra"], 0.21]
    target = "results/runs/2nd_E2_K0.5_theta0/manifest.tsv"
    with ExitStack() as stack:
        for name in written:
            file = stack.enter_context(open(copied_study.results / "runs" / name, "rb"))
            fcntl.flock(file, fcntl.LOCK_EX)
        failed = copied_study.snakemake(target, "--cores", "1", config=tiny)
    assert failed.returncode != 0
    assert "HDF5_USE_FILE_LOCKING=FALSE" in failed.stderr
    assert "Traceback" not in failed.stderr
    copied_study.build(tiny, target)
    now = copied_study.runs()
    assert {name: now[name] for name in written} == written
    assert len(now) > len(written)
