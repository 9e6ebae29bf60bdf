import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path
from types import SimpleNamespace

import pytest
from snakemake.scheduling.job_scheduler import JobRateLimiter
from snakemake.settings.types import MaxJobsPerTimespan

from bladerub.config import record
from bladerub.config.record import Record
from bladerub.io.errors import BadInput
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.workflow import invocation


@pytest.fixture
def manifest(tmp_path):
    """Of two runs, one of which has a longer one."""
    folder = tmp_path / "results" / "runs" / "2nd_E2_K0.5_theta0"
    (folder / "confirmation").mkdir(parents=True)
    for name, size in (("0.1.h5", 10), ("0.2.h5", 20), ("confirmation/0.2.h5", 30)):
        (folder / name).write_bytes(bytes(size))
    rows = [
        ManifestRow("0.1.h5", 0.1, "a", "completed", 10),
        ManifestRow("0.2.h5", 0.2, "b", "completed", 20, "c", 30),
    ]
    write_manifest(folder / "manifest.tsv", rows)
    return folder / "manifest.tsv"


def test_a_whole_coating_has_no_loss(manifest):
    assert invocation.loss(manifest) is None
    assert invocation.loss(manifest.with_name("none.tsv")) is None


@pytest.mark.parametrize(("name", "size"), [("0.1.h5", None), ("confirmation/0.2.h5", 9)])
def test_a_run_that_is_missing_or_cut_short_is_a_loss(manifest, name, size):
    run = manifest.parent / name
    run.unlink() if size is None else run.write_bytes(bytes(size))
    assert str(run) in invocation.loss(manifest)


@pytest.fixture
def workflow_with(tmp_path, monkeypatch):
    """What `plan` and `start` see of Snakemake's workflow."""
    persistence = SimpleNamespace(path=tmp_path, all_outputfiles=list, all_inputfiles=list)
    monkeypatch.setattr(invocation, "_planned", [])

    def workflow(limiter=None, local_exec=True, targets=()):
        return SimpleNamespace(
            scheduler=SimpleNamespace(job_rate_limiter=limiter),
            local_exec=local_exec,
            persistence=persistence,
            dag_settings=SimpleNamespace(targets=list(targets)),
        )

    return workflow


@pytest.fixture
def of_quick(tmp_path):
    """Results that were made with the quick config and a value."""
    record.write(tmp_path, ["config/quick.yaml"], {"solver": {"revolutions": 3}})
    return str(tmp_path)


NAMED = """--configfile config/quick.yaml --config 'solver={"revolutions": 3}'"""


def test_targets_of_results_of_another_config_are_refused(workflow_with, of_quick):
    workflow = workflow_with(targets={"stress"})
    invocation.plan(of_quick, Record(()))
    with pytest.raises(BadInput) as refused:
        invocation.start(workflow)
    assert NAMED in str(refused.value)


@pytest.mark.parametrize(
    ("rate", "local_exec", "kept"), [("100/1s", True, False), ("100/1s", False, True), ("1/1m", True, True)]
)
def test_the_default_limit_of_jobs_alone_is_lifted_on_this_machine(workflow_with, rate, local_exec, kept):
    workflow = workflow_with(JobRateLimiter(MaxJobsPerTimespan.parse_choice(rate)), local_exec)
    invocation.start(workflow)
    assert (workflow.scheduler.job_rate_limiter is not None) == kept


def test_a_handler_of_sigterm_may_wait_for_what_the_main_thread_holds(workflow_with):
    lock, handled = threading.Lock(), threading.Event()

    def handler(*_):
        if lock.acquire(timeout=2):  # Snakemake's waits for ever
            handled.set()

    before = signal.signal(signal.SIGTERM, handler)
    try:
        invocation.start(workflow_with(limiter=None))
        with lock:
            os.kill(os.getpid(), signal.SIGTERM)
        assert handled.wait(3)
    finally:
        signal.signal(signal.SIGTERM, before)


def test_the_rules_do_not_import_the_compiler():
    """Each call of snakemake would wait for it, and each of its jobs on a cluster."""
    imports = re.compile(r"^(?:import bladerub.*|from bladerub\S* import (?:\([^)]*\)|.*))$", re.M)
    texts = [
        path.read_text(encoding="utf-8")
        for path in (Path("Snakefile"), *Path("src/rules").iterdir(), *Path("studies").glob("*/rules.smk"))
    ]
    statements = [statement for text in texts for statement in imports.findall(text)]
    assert "import bladerub.workflow.invocation" in statements
    program = "\n".join([*statements, "import sys", "print('numba' in sys.modules)"])
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"


def test_two_interrupts_in_a_row_are_one(workflow_with, tmp_path, monkeypatch):
    clock = iter([100.0, 100.3, 200.0])
    monkeypatch.setattr(invocation.time, "monotonic", lambda: next(clock))
    before = signal.getsignal(signal.SIGINT)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        invocation.plan(str(tmp_path), Record(()))
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)
        with pytest.raises(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
    finally:
        signal.signal(signal.SIGINT, before)


def test_an_environment_that_snakemake_cannot_name_to_a_shell_is_refused(workflow_with, monkeypatch):
    monkeypatch.setattr(sys, "executable", "/home/two words/.venv/bin/python")
    with pytest.raises(BadInput, match="two words"):
        invocation.start(workflow_with())


def test_files_of_the_future_are_of_now(tmp_path, capsys):
    old, new = tmp_path / "runs" / "old.h5", tmp_path / "runs" / "new.h5"
    old.parent.mkdir()
    for path, change in ((old, -3600), (new, 7200)):
        path.touch()
        os.utime(path, 2 * (time.time() + change,))
    before = old.stat().st_mtime
    invocation.date_back(tmp_path)
    assert old.stat().st_mtime == before
    assert abs(new.stat().st_mtime - time.time()) < 60
    assert "files of the future, by a clock that was ahead: 1" in capsys.readouterr().err
