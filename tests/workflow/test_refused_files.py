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


@pytest.fixture
def results(copied_study, tiny):
    tiny["ensemble"] = {"members": 2}
    copied_study.build(tiny)
    return copied_study.results


def contents(results):
    """All that a study keeps, with what changes when a file is written."""
    folders = ("blade", "runs", "maps", "ensembles", "tables", "figures")
    paths = [path for folder in folders for path in (results / folder).rglob("*") if path.is_file()]
    return {path: (path.stat().st_ino, path.stat().st_mtime_ns, path.read_bytes()) for path in paths}


@pytest.mark.parametrize(
    ("code", "kinds"),
    [
        (errno.EIO, ["runs"]),
        *(
            pytest.param(c, [*FILES], marks=pytest.mark.nightly)
            for c in (errno.EACCES, errno.EMFILE, errno.EIO)
        ),
    ],
)
def test_what_the_system_refuses_is_kept_by_all_commands(copied_study, results, code, kinds):
    before = contents(results)
    for kind in kinds:
        for command in ON_RESULTS:
            path = f"{REFUSALS}:{copied_study.sources}"
            done = call(copied_study, command, PYTHONPATH=path, REFUSED=FILES[kind], REFUSAL=str(code))
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
