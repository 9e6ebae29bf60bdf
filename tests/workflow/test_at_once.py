"""Two invocations at the same time: in one folder, and in two that share their results."""

import subprocess
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait

import pytest
import yaml

from bladerub.io import lock

COATING = "2nd_E2_K0.5_theta0"
COMMAND = f"results/runs/{COATING}/manifest.tsv", "--cores", "1"


@pytest.fixture
def begin():
    processes = []

    def started(workspace):
        processes.append(workspace.begin(*COMMAND))
        return processes[-1]

    yield started
    for process in processes:
        process.kill()
        process.wait()


def wait_until(condition, *processes):
    for number in range(600):
        if condition():
            return
        with pytest.raises(subprocess.TimeoutExpired):
            processes[number % len(processes)].wait(0.1)
    pytest.fail("what was waited for did not come within a minute")


def contains(path, text):
    return lambda: path.is_file() and text in path.read_text()


def waits(log):
    return contains(log, "another job is at work in")


def has_waiters(path, number):
    waiting = f":{path.stat().st_ino} "
    with open("/proc/locks") as locks:
        return sum(waiting in line and "->" in line for line in locks) == number


@pytest.fixture
def begun(copied_study, tiny):
    """A study of which one coating is to be done again, and the log of its job."""
    (copied_study.folder / "overlay.yaml").write_text(yaml.safe_dump(tiny))
    coating = copied_study.results / "runs" / COATING
    (coating / "manifest.tsv").unlink()
    return copied_study, coating, copied_study.results / "logs" / "coating" / f"{COATING}.log"


def test_the_second_in_a_folder_is_kept_out_and_loses_nothing(begun, begin, tiny):
    study, coating, log = begun
    with lock.held(coating / ".lock", lambda: None):  # so that the first stays at work
        first = begin(study)
        wait_until(waits(log), first)
        said = study.failure(*COMMAND, "--configfile", "overlay.yaml")
        assert "another snakemake is at work in this folder" in said
        counts = study.status()
        assert (counts["planned"], counts["done"], counts["damaged"]) == (6 * 8, 6 * 8, [])
        assert first.poll() is None
    assert first.wait(300) == 0
    assert study.plan(tiny, COMMAND[0]) == {}


def test_two_folders_with_the_same_results_compute_each_run_once(begun, begin, tmp_path):
    study, coating, _ = begun
    for speed in (0.1970, 0.2300):
        (coating / f"{speed:.4f}.h5").unlink()
    other = type(study).at(tmp_path / "other")
    for shared in ("overlay.yaml", "results"):
        (other.folder / shared).symlink_to(study.folder / shared)
    with lock.held(coating / ".lock", lambda: None):
        both = [begin(study)]
        wait_until(lambda: has_waiters(coating / ".lock", 1), *both)
        both.append(begin(other))  # after it: Snakemake fails if a file goes while it plans
        wait_until(lambda: has_waiters(coating / ".lock", 2), *both)
    with ThreadPoolExecutor() as pool:
        ends = [pool.submit(process.wait, 300) for process in both]
        wait(ends, return_when=FIRST_COMPLETED)
        runs = study.runs()
        assert len(study.runs("*/*.h5")) == 6 * 8
        assert [end.result() for end in ends] == [0, 0]
    assert study.runs() == runs


def test_a_job_that_outlives_its_snakemake_is_waited_for(begun, begin):
    study, coating, log = begun
    runs = study.runs()
    with lock.held(coating / ".lock", lambda: None):
        first = begin(study)
        wait_until(waits(log), first)
        first.kill()
        first.wait()
        second = begin(study)
        log.unlink()
        wait_until(contains(study.folder / "output.txt", "the last snakemake here was killed"), second)
        wait_until(waits(log), second)
        assert second.poll() is None
    assert second.wait(300) == 0
    assert study.runs() == runs
    assert (coating / "manifest.tsv").is_file()
