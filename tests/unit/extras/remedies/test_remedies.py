import json
import os
import signal
import subprocess
import sys
import threading
import time
from types import SimpleNamespace

import pytest
from snakemake.scheduling.job_scheduler import JobRateLimiter
from snakemake.settings.types import MaxJobsPerTimespan

from bladerub.extras.remedies import snakemake as remedies
from bladerub.extras.remedies.snakemake import claim
from bladerub.io.errors import BadInput


@pytest.fixture
def workflow_with(tmp_path, monkeypatch):
    monkeypatch.setenv("PYTHONPATH", "")
    own = {"persistence": SimpleNamespace(path=tmp_path, all_outputfiles=list, all_inputfiles=list)}
    return lambda limiter=None, local_exec=True: SimpleNamespace(
        scheduler=SimpleNamespace(job_rate_limiter=limiter), local_exec=local_exec, **own
    )


@pytest.mark.parametrize(
    ("rate", "local_exec", "kept"), [("100/1s", True, False), ("100/1s", False, True), ("1/1m", True, True)]
)
def test_the_default_limit_of_jobs_alone_is_lifted_on_this_machine(workflow_with, rate, local_exec, kept):
    workflow = workflow_with(JobRateLimiter(MaxJobsPerTimespan.parse_choice(rate)), local_exec)
    remedies.start(workflow, [])
    assert (workflow.scheduler.job_rate_limiter is not None) == kept


def test_an_environment_that_snakemake_cannot_name_to_a_shell_is_refused(workflow_with, monkeypatch):
    monkeypatch.setattr(sys, "executable", "/home/two words/.venv/bin/python")
    with pytest.raises(BadInput, match="two words"):
        remedies.start(workflow_with(), [])


@pytest.fixture
def handle():
    before = {sign: signal.getsignal(sign) for sign in (signal.SIGTERM, signal.SIGINT)}
    yield signal.signal
    for sign, handler in before.items():
        signal.signal(sign, handler)


def test_a_handler_of_sigterm_may_wait_for_what_the_main_thread_holds(workflow_with, handle):
    lock, handled = threading.Lock(), threading.Event()

    def handler(*_):
        if lock.acquire(timeout=2):  # Snakemake's waits for ever
            handled.set()

    handle(signal.SIGTERM, handler)
    remedies.start(workflow_with(limiter=None), [])
    with lock:
        os.kill(os.getpid(), signal.SIGTERM)
    assert handled.wait(3)


def test_two_interrupts_in_a_row_are_one(handle, monkeypatch):
    clock = iter([100.0, 100.3, 200.0])
    monkeypatch.setattr(remedies.time, "monotonic", lambda: next(clock))
    handle(signal.SIGINT, signal.default_int_handler)
    remedies.begin()
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)
    signal.raise_signal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        signal.raise_signal(signal.SIGINT)


def test_an_interrupt_before_the_first_line_of_a_script_prints_nothing(tmp_path):
    (tmp_path / "sitecustomize.py").write_text("print('of the environment')")
    folders = os.pathsep.join([str(remedies.START_OF_JOBS), str(tmp_path)])
    command, environment = [sys.executable, "-c", "raise KeyboardInterrupt"], {"PYTHONPATH": folders}
    done = subprocess.run(command, env=os.environ | environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "of the environment\n", "")


def test_files_of_the_future_are_of_now(tmp_path, capsys):
    old, new = tmp_path / "runs" / "old.h5", tmp_path / "runs" / "new.h5"
    old.parent.mkdir()
    for path, change in ((old, -3600), (new, 7200)):
        path.touch()
        os.utime(path, 2 * (time.time() + change,))
    before = old.stat().st_mtime
    remedies.date_back(tmp_path)
    assert old.stat().st_mtime == before
    assert abs(new.stat().st_mtime - time.time()) < 60
    assert "files of the future, by a clock that was ahead: 1" in capsys.readouterr().err


CLAIM = """
import sys
from bladerub.extras.remedies.snakemake import claim
print(claim(sys.argv[1], ["a", "b"], ["c"]), flush=True)
sys.stdin.read()
"""


def test_who_makes_or_needs_what_another_makes_is_kept_out_until_it_dies(python_at_work, tmp_path):
    other = python_at_work(CLAIM, tmp_path)
    for outputs, inputs in (("a", ""), ("x", "b"), ("c", "")):
        with pytest.raises(BadInput, match="another snakemake is at work"):
            claim(tmp_path, outputs, inputs)
    assert claim(tmp_path, "x", "c") is False  # who shares but inputs is let in
    other.kill()
    other.wait()
    assert claim(tmp_path, "a", "c") is True


def test_an_orderly_end_leaves_no_claim(python_at_work, tmp_path):
    other = python_at_work(CLAIM, tmp_path)
    (claimed,) = tmp_path.glob("*.json")
    assert json.loads(claimed.read_text()) == {"makes": ["a", "b"], "needs": ["c"]}
    other.communicate()
    assert list(tmp_path.glob("*.json")) == []
