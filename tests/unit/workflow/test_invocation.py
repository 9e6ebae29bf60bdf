import json
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
from bladerub.io.folders import ROOT
from bladerub.study.manifest import ManifestRow, write_manifest
from bladerub.workflow import invocation, settings
from bladerub.workflow.claims import claim
from bladerub.workflow.studies import rules_of_studies


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


@pytest.mark.parametrize(
    ("name", "size"), [("0.1.h5", None), ("confirmation/0.2.h5", 9), ("confirmation/0.2.h5", 30)]
)
def test_a_run_that_is_missing_or_cut_short_is_a_loss(manifest, name, size):
    run = manifest.parent / name
    run.unlink() if size is None else run.write_bytes(bytes(size))
    loss = invocation.loss(manifest)
    assert loss is None if size == 30 else str(run) in loss
    assert invocation.loss(manifest.with_name("none.tsv")) is None


@pytest.fixture
def workflow_with(tmp_path, monkeypatch):
    """What `plan` and `start` see of Snakemake's workflow."""
    persistence = SimpleNamespace(path=tmp_path, all_outputfiles=list, all_inputfiles=list)
    monkeypatch.setattr(invocation, "_planned", [])
    monkeypatch.setenv("PYTHONPATH", "")

    def workflow(limiter=None, local_exec=True, targets=()):
        return SimpleNamespace(
            scheduler=SimpleNamespace(job_rate_limiter=limiter),
            local_exec=local_exec,
            persistence=persistence,
            dag_settings=SimpleNamespace(targets=list(targets)),
        )

    return workflow


def test_targets_of_results_of_another_config_are_refused(workflow_with, tmp_path):
    record.write(tmp_path, ["config/quick.yaml"], {"solver": {"revolutions": 3}})
    invocation.plan(str(tmp_path), Record(()))
    made_with = """--configfile config/quick.yaml --config 'solver={"revolutions": 3}'"""
    with pytest.raises(BadInput, match=re.escape(made_with)):
        invocation.start(workflow_with(targets={"stress"}))


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


def test_an_interrupt_before_the_first_line_of_a_script_prints_nothing(tmp_path):
    (tmp_path / "sitecustomize.py").write_text("print('of the environment')")
    folders = os.pathsep.join([str(invocation.START_OF_JOBS), str(tmp_path)])
    done = subprocess.run(
        [sys.executable, "-c", "raise KeyboardInterrupt"],
        env=os.environ | {"PYTHONPATH": folders},
        capture_output=True,
        text=True,
    )
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "of the environment\n", "")


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


CLAIM = """
import sys
from bladerub.workflow.claims import claim
print(claim(sys.argv[1], ["a", "b"], ["c"]), flush=True)
sys.stdin.read()
"""


@pytest.fixture
def other(tmp_path):
    """Another process, which makes a and b of c."""
    with subprocess.Popen(
        [sys.executable, "-c", CLAIM, tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout.readline() == "False\n"
        yield process
        process.kill()


def test_who_makes_or_needs_what_another_makes_is_kept_out_until_it_dies(other, tmp_path):
    for outputs, inputs in (("a", ""), ("x", "b"), ("c", "")):
        with pytest.raises(BadInput, match="another snakemake is at work"):
            claim(tmp_path, outputs, inputs)
    assert claim(tmp_path, "x", "c") is False  # who shares but inputs is let in
    other.kill()
    other.wait()
    assert claim(tmp_path, "a", "c") is True


def test_an_orderly_end_leaves_no_claim(other, tmp_path):
    (claimed,) = tmp_path.glob("*.json")
    assert json.loads(claimed.read_text()) == {"makes": ["a", "b"], "needs": ["c"]}
    other.communicate()
    assert list(tmp_path.glob("*.json")) == []


def test_a_study_without_its_extra_is_left_out(tmp_path):
    for name, extra in (("one", "cost.jobs"), ("two", "nowhere.table"), ("three", "chart.stress")):
        (tmp_path / "studies" / name / "scripts").mkdir(parents=True)
        (tmp_path / "studies" / name / "rules.smk").write_text(f'files_behind("extras.{extra}")\n')
    script = tmp_path / "studies" / "three" / "scripts" / "three.py"
    script.write_text("from bladerub.extras.lost import table\n")
    complete, notes = rules_of_studies(tmp_path)
    assert [path.parent.name for path in complete] == ["one"]
    assert notes == [
        "without the study three, which needs bladerub.extras.lost",
        "without the study two, which needs bladerub.extras.nowhere",
    ]


@pytest.mark.parametrize("by_file", [False, True])
def test_a_module_statement_and_the_command_line_are_laid_over_the_study(tmp_path, monkeypatch, by_file):
    path, given = tmp_path / "my.yaml", {"solver": {"revolutions": 30}}
    path.write_text("solver: {revolutions: 30}\n")
    files, values = ([path], {}) if by_file else ([], {"dpi": 3})
    command_line = SimpleNamespace(
        configfiles=files, config=values, overwrite_config=given if files else values
    )
    workflow = SimpleNamespace(config_settings=command_line, is_main_process=True)
    for folder in [ROOT] if by_file else [ROOT, tmp_path]:  # there is a study, or none
        monkeypatch.chdir(folder)
        study, notes, laid_over = settings.read(workflow, given)
        assert (study["solver"]["revolutions"], notes) == (30, [])
        assert list(laid_over.files) == files
        assert by_file or laid_over == Record((), given)
