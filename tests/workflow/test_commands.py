"""Every command on the tiny study, as a user gives it: in other locales, and where files cannot be read.

What the system refuses to read (locks, permissions, failing disks) is neither lost nor made again.
"""

import errno
import fcntl
import os
from contextlib import ExitStack
from pathlib import Path

import pytest

COATING = "2nd_E1.1_K0.5_theta0"
RUN = ("run", "--casing", "2nd", "--E", "1.1", "--K", "0.5", "--f", "0.197", "--revolutions", "2")
ON_RESULTS = [
    ("bladerub", "status"),
    ("bladerub", "status", "--thorough"),
    ("bladerub", "status", "--thorough", "--discard"),
    ("bladerub", "verify", "--sample", "1", "--seed", "1"),
    ("bladerub", *RUN),
    ("bladerub", "export", "--animation", "a.gif", "--run", f"results/runs/{COATING}/0.1970.h5"),
    ("bladerub", "compare", "results/tables", "results/tables"),
    ("snakemake", "-j1", "--quiet", "all", "--dry-run"),
    ("snakemake", "-j1", "--quiet", "all", "--keep-going"),
    ("python", "-c", f"import bladerub as br; br.read_map('results/maps/{COATING}.h5')"),
]
"""Those that read what a study has computed."""
OTHERS = [
    ("bladerub", "new", "a study"),
    ("bladerub", "config", "overlay.yaml"),
    ("bladerub", "import", "config/blades/twisted_plate.inp"),
    ("bladerub", "import", "none.msh"),
    ("bladerub", "fit-coating", "none.csv"),
    ("bladerub", "check-law", "brittle", "--parameter", "break_strain=5e-3"),
    ("bladerub", "benchmark", "--rounds", "1", "--nodes", "8"),
    ("bladerub", "export", "--sections", "sections.csv"),
    ("snakemake", "-j1", "results/figures/fig02_campbell.png", "--force"),
]
LOCALES = {
    "ASCII": {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"},
    "German": {"LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8", "LANGUAGE": "de"},
}
FEW = [command for command in ON_RESULTS + OTHERS if command[1] in ("status", "run", "config")]
REFUSALS = Path(__file__).with_name("refusals")
FILES = {
    "runs": r"/runs/.*\.h5$",
    "maps": r"/maps/.*\.h5$",
    "ensembles": r"/ensembles?/.*\.h5$",
    "manifests": r"/manifest\.tsv$",
    "blade": r"/blade/.*\.h5$",
    "tables": r"/tables/.*\.csv$",
}


def call(study, command, **environment):
    name, *arguments = command
    if name == "snakemake":
        arguments += ["--configfile", "overlay.yaml"]
    elif name == "bladerub" and arguments[0] not in ("new", "config", "compare"):
        arguments += ["--config", "overlay.yaml"]
    return study.call(name, *arguments, **environment)


@pytest.mark.parametrize(
    ("locale", "commands"),
    [
        ("ASCII", FEW),
        *(pytest.param(name, ON_RESULTS + OTHERS, marks=pytest.mark.nightly) for name in LOCALES),
    ],
)
def test_commands_answer_in_any_locale(copied_study, locale, commands):
    for command in commands:
        done = call(copied_study, command, **LOCALES[locale])
        said = done.stdout + done.stderr
        assert not any(error in said for error in ("Traceback", "UnicodeEncodeError")), (command, said)
        is_refused = "none." in command[-1] or command[1] == "compare"  # by design: it has no numbers
        assert (done.returncode == 0) != is_refused, (command, said)


def contents(results):
    """All that a study keeps, with what changes when a file is written."""
    folders = ("blade", "runs", "maps", "ensembles", "tables", "figures")
    paths = [path for folder in folders for path in (results / folder).rglob("*") if path.is_file()]
    return {path: (path.stat().st_ino, path.stat().st_mtime_ns, path.read_bytes()) for path in paths}


def keeps_all(study, kinds, commands, code):
    """Give the commands, which may change nothing of a study; what they said."""
    before, said = contents(study.results), []
    for kind in kinds:
        for command in commands:
            path = f"{REFUSALS}:{study.sources}"
            done = call(study, command, PYTHONPATH=path, REFUSED=FILES[kind], REFUSAL=str(code))
            assert contents(study.results) == before, (kind, command, done.stderr)
            assert command[0] == "python" or "Traceback" not in done.stderr, (kind, command, done.stderr)
            said.append(done.stdout + done.stderr)
    return said


def test_runs_that_the_system_refuses_are_kept(copied_study):
    discarding, computing = ON_RESULTS[2], ON_RESULTS[8]
    for output in (f"runs/{COATING}/manifest.tsv", f"maps/{COATING}.h5"):  # else there is nothing to compute
        (copied_study.results / output).unlink()
    for said in keeps_all(copied_study, ["runs"], (discarding, computing), errno.EIO):
        assert os.strerror(errno.EIO) in said  # it was refused


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
        said = copied_study.failure(target, "--cores", "1", config=tiny)
    assert "HDF5_USE_FILE_LOCKING=FALSE" in said
    copied_study.build(tiny, target)
    now = copied_study.runs()
    assert {name: now[name] for name in written} == written
    assert len(now) > len(written)
